// Scenes built in memory, and cameras to look at them: what known answers are known of.
#pragma once

#include "scene/scene.h"

#include <string>

namespace wavepath {

// Lambert's reflector: without the glTF dielectric's specular layer, which gains energy.
Material lambert(const Rgb& albedo, const Rgb& emission = {0, 0, 0}, bool double_sided = false);
Material metal(const Rgb& base_color, float roughness);

inline Rgb grey(float value) {
    return {value, value, value};
}

// Of this extinction [1/m], albedo [1] and mean cosine g [1].
Medium medium_of(double sigma_t, double albedo, double g = 0);
// An index-matched boundary: light passes straight.
Material boundary_of(const Medium& medium);

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

Camera perspective(const Vec3d& eye, const Vec3d& target, double y_fov);
// Sees a square (in a square image) of this side; its rays start in the plane through `eye`.
Camera orthographic(const Vec3d& eye, const Vec3d& target, double side);
// Looks straight down at the point `p` of a surface of this normal, from `height` above it.
Camera close_up(const Vec3d& p, const Vec3d& normal, double height, double footprint);

// Moves everything by world' = scale * world + shift: nodes, lights (intensity by scale^2), and
// `camera`. Media have the same optical thickness after.
void transform(Scene& scene, Camera& camera, double scale, const Vec3d& shift);

}  // namespace wavepath
