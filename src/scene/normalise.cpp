#include "scene/normalise.h"

#include "error.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wavepath {

namespace {

// Twice the least area that counts: the square of a smaller normal leaves single precision.
constexpr double smallest_cross = 1e-18;

struct Bounds {
    Vec3d low{
        std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::infinity()};
    Vec3d high{
        -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()};

    void extend(const Vec3d& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
};

Bounds world_bounds(const Scene& scene) {
    Bounds bounds;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const uint32_t index : primitive.indices)
            bounds.extend(transform_point(instance.to_world, vec3_at(primitive.positions, index)));
    }
    return bounds;
}

// Its length is twice the triangle's area.
Vec3d face_cross(const std::array<Vec3d, 3>& p) {
    const Vec3d u{p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]};
    const Vec3d v{p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
    return cross(u, v);
}

void append(std::vector<float>& to, const Vec3d& v) {
    for (const double x : v) to.push_back(static_cast<float>(x));
}

// Adds the triangles of one instance; corners are rounded to float first, as the device will see
// them.
void append_instance(
    NormalisedScene& out,
    const Primitive& primitive,
    const Matrix4& to_world,
    bool normals,
    bool colors) {
    const bool mirrored = dot(axis(to_world, 0), cross(axis(to_world, 1), axis(to_world, 2))) < 0;
    for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
        std::array<uint32_t, 3> corners{
            primitive.indices[t], primitive.indices[t + 1], primitive.indices[t + 2]};
        if (mirrored) std::swap(corners[1], corners[2]);
        std::array<Vec3d, 3> p;
        for (std::size_t c = 0; c < 3; ++c) {
            p[c] = out.to_normalised(
                transform_point(to_world, vec3_at(primitive.positions, corners[c])));
            for (double& x : p[c]) x = static_cast<float>(x);
        }
        const Vec3d face = face_cross(p);
        if (dot(face, face) < smallest_cross * smallest_cross) {
            ++out.dropped;
            continue;
        }
        for (const Vec3d& corner : p) append(out.positions, corner);
        out.materials.push_back(primitive.material);
        if (normals) {
            for (const uint32_t c : corners)
                append(
                    out.normals, primitive.normals.empty()
                                     ? normalized(face)
                                     : transform_normal(to_world, vec3_at(primitive.normals, c)));
        }
        if (colors)
            for (const uint32_t c : corners)
                append(
                    out.colors,
                    primitive.colors.empty() ? Vec3d{1, 1, 1} : vec3_at(primitive.colors, c));
    }
}

PunctualLight normalised_light(const NormalisedScene& space, PunctualLight light) {
    light.position = space.to_normalised(light.position);
    light.range /= space.extent.metres;
    if (light.kind != LightKind::directional)
        for (float& channel : light.intensity)
            channel = static_cast<float>(channel / (space.extent.metres * space.extent.metres));
    return light;
}

}  // namespace

Vec3d NormalisedScene::to_normalised(const Vec3d& world) const {
    Vec3d p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = (world[k] - extent.centre[k]) / extent.metres;
    return p;
}

Extent extent_of(const Scene& scene) {
    const Bounds bounds = world_bounds(scene);
    Extent extent;
    extent.metres = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        extent.centre[k] = 0.5 * (bounds.low[k] + bounds.high[k]);
        extent.metres = std::max(extent.metres, bounds.high[k] - bounds.low[k]);
    }
    if (!std::isfinite(extent.metres) || extent.metres <= 0)
        throw Error(
            "{}: the scene's extent is {} m; give it triangles with an area", scene.name,
            extent.metres);
    return extent;
}

NormalisedScene normalise(const Scene& scene) {
    NormalisedScene out;
    out.extent = extent_of(scene);
    bool normals = false;
    bool colors = false;
    for (const Instance& instance : scene.instances) {
        normals = normals || !scene.primitives[instance.primitive].normals.empty();
        colors = colors || !scene.primitives[instance.primitive].colors.empty();
    }
    for (const Instance& instance : scene.instances) {
        append_instance(
            out, scene.primitives[instance.primitive], instance.to_world, normals, colors);
        out.ends.push_back(static_cast<uint32_t>(out.triangle_count()));
    }
    if (out.materials.empty())
        throw Error("{}: every triangle has zero area; there is nothing to render", scene.name);
    for (const PunctualLight& light : scene.lights)
        out.lights.push_back(normalised_light(out, light));
    return out;
}

}  // namespace wavepath
