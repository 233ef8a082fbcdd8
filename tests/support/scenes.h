// Scenes built in memory, and cameras to look at them.
#pragma once

#include "scene/scene.h"

#include <string>

namespace wavepath {

// Lambert's reflector: without the glTF dielectric's specular layer, which gains energy.
Material lambert(const Rgb& albedo, const Rgb& emission = {0, 0, 0}, bool double_sided = false);
Material metal(const Rgb& base_color, float roughness);
Material dielectric(const Rgb& base_color, float roughness);

inline Rgb grey(float value) {
    return {value, value, value};
}

enum class Facing { outward, inward };

Scene scene_named(const std::string& name);
Environment constant_environment(float radiance);

// Each adds one primitive with a material of its own and an instance of it; returns the primitive.
Primitive& add_triangles(
    Scene& scene,
    const Material& material,
    std::vector<float> positions,
    std::vector<uint32_t> indices);
// The parallelogram corner, corner + u, corner + u + v, corner + v; its front is where u x v
// points.
Primitive& add_quad(
    Scene& scene, const Material& material, const Vec3d& corner, const Vec3d& u, const Vec3d& v);
// A square of this side around `centre`, its front towards `normal` (any length).
Primitive& add_square(
    Scene& scene, const Material& material, const Vec3d& centre, const Vec3d& normal, double side);
Primitive& add_box(
    Scene& scene, const Material& material, const Vec3d& low, const Vec3d& high, Facing facing);
// 20 * 4^subdivisions triangles, of the volume of the sphere.
Primitive& add_icosphere(
    Scene& scene,
    const Material& material,
    const Vec3d& centre,
    double radius,
    int subdivisions,
    Facing facing = Facing::outward);

// Gives the triangles of the scene's last primitive, from `first_index` of its indices on, to
// another primitive of this material. The two are one body.
void split_off(Scene& scene, std::size_t first_index, const Material& material);

// The sagitta of an icosphere relative to its radius: how far it lies from its sphere.
double icosphere_sagitta(int subdivisions);

Camera perspective(const Vec3d& eye, const Vec3d& target, double y_fov);
// Sees a square (in a square image) of this side; its rays start in the plane through `eye`.
Camera orthographic(const Vec3d& eye, const Vec3d& target, double side);
// Looks straight down at the point `p` of a surface of this normal, from `height` above it.
Camera close_up(const Vec3d& p, const Vec3d& normal, double height, double footprint);

// Moves everything by world' = scale * world + shift: nodes, lights (intensity by scale^2), and
// `camera`. Media have the same optical thickness after.
void transform(Scene& scene, Camera& camera, double scale, const Vec3d& shift);

}  // namespace wavepath
