#include "scene/shapes.h"

#include "scene/camera.h"
#include "scene/transform.h"

#include <cmath>
#include <utility>

namespace wavepath {

namespace {

void append(std::vector<float>& to, const Vec3d& v) {
    for (const double x : v) to.push_back(static_cast<float>(x));
}

Matrix4 moved(const Matrix4& m, double scale, const Vec3d& shift) {
    Matrix4 r = m;
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t k = 0; k < 3; ++k) r[4 * column + k] *= scale;
    for (std::size_t k = 0; k < 3; ++k) r[12 + k] += shift[k];
    return r;
}

}  // namespace

Material lambert(const Rgb& albedo, const Rgb& emission, bool double_sided) {
    Material m;
    m.base_color = albedo;
    m.metallic = 0;
    m.specular = 0;
    m.emission = emission;
    m.double_sided = double_sided;
    return m;
}

Material metal(const Rgb& base_color, float roughness) {
    Material m;
    m.base_color = base_color;
    m.roughness = roughness;
    return m;
}

Scene scene_named(const std::string& name) {
    Scene scene;
    scene.name = name;
    return scene;
}

Environment constant_environment(float radiance) {
    Environment environment;
    environment.radiance = grey(radiance);
    return environment;
}

Primitive& add_triangles(
    Scene& scene,
    const Material& material,
    std::vector<float> positions,
    std::vector<uint32_t> indices) {
    Primitive primitive;
    primitive.name = "mesh " + std::to_string(scene.primitives.size());
    primitive.positions = std::move(positions);
    primitive.indices = std::move(indices);
    primitive.material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    const auto primitive_index = static_cast<uint32_t>(scene.primitives.size());
    scene.instances.push_back({primitive_index, identity_matrix, primitive_index});
    scene.primitives.push_back(std::move(primitive));
    return scene.primitives.back();
}

Primitive& add_quad(
    Scene& scene, const Material& material, const Vec3d& corner, const Vec3d& u, const Vec3d& v) {
    std::vector<float> positions;
    for (const Vec3d& p : {corner, plus(corner, u), plus(plus(corner, u), v), plus(corner, v)})
        append(positions, p);
    return add_triangles(scene, material, std::move(positions), {0, 1, 2, 0, 2, 3});
}

Primitive& add_square(
    Scene& scene, const Material& material, const Vec3d& centre, const Vec3d& normal, double side) {
    const Vec3d n = normalized(normal);
    const Vec3d u = normalized(cross(std::abs(n[1]) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1}, n));
    const Vec3d v = cross(n, u);
    const Vec3d corner = plus(centre, times(plus(u, v), -side / 2));
    return add_quad(scene, material, corner, times(u, side), times(v, side));
}

Primitive& add_box(
    Scene& scene, const Material& material, const Vec3d& low, const Vec3d& high, Facing facing) {
    std::vector<float> positions;
    for (uint32_t i = 0; i < 8; ++i)
        append(
            positions,
            {i & 1U ? high[0] : low[0], i & 2U ? high[1] : low[1], i & 4U ? high[2] : low[2]});
    std::vector<uint32_t> indices{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    if (facing == Facing::inward)
        for (std::size_t i = 0; i < indices.size(); i += 3)
            std::swap(indices[i + 1], indices[i + 2]);
    return add_triangles(scene, material, std::move(positions), std::move(indices));
}

Camera perspective(const Vec3d& eye, const Vec3d& target, double y_fov) {
    return look_at(eye, target, y_fov);
}

Camera orthographic(const Vec3d& eye, const Vec3d& target, double side) {
    Camera camera = look_at(eye, target, 1);
    camera.orthographic = true;
    camera.x_mag = side / 2;
    camera.y_mag = side / 2;
    return camera;
}

Camera close_up(const Vec3d& p, const Vec3d& normal, double height, double footprint) {
    return orthographic(plus(p, times(normalized(normal), height)), p, footprint);
}

void transform(Scene& scene, Camera& camera, double scale, const Vec3d& shift) {
    for (Instance& instance : scene.instances)
        instance.to_world = moved(instance.to_world, scale, shift);
    for (PunctualLight& light : scene.lights) {
        light.position = plus(times(light.position, scale), shift);
        light.range *= scale;
        if (light.kind != LightKind::directional)
            for (float& channel : light.intensity)
                channel = static_cast<float>(channel * scale * scale);
    }
    for (Material& material : scene.materials)
        for (Rgb* per_metre :
             {&material.medium.sigma_a, &material.medium.sigma_s, &material.medium.emission})
            for (float& channel : *per_metre) channel = static_cast<float>(channel / scale);
    camera.to_world = moved(camera.to_world, scale, shift);
    camera.x_mag *= scale;
    camera.y_mag *= scale;
}

Medium medium_of(double sigma_t, double albedo, double g) {
    Medium medium;
    medium.sigma_a = grey(static_cast<float>(sigma_t * (1 - albedo)));
    medium.sigma_s = grey(static_cast<float>(sigma_t * albedo));
    medium.anisotropy = static_cast<float>(g);
    return medium;
}

Material boundary_of(const Medium& medium) {
    Material material = lambert(grey(1));
    material.boundary = Boundary::index_matched;
    material.transmission = 1;
    material.medium = medium;
    return material;
}

}  // namespace wavepath
