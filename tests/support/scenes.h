// Scenes built in memory, beyond those of scene/shapes.h.
#pragma once

#include "scene/shapes.h"

namespace wavepath {

Material dielectric(const Rgb& base_color, float roughness);

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

}  // namespace wavepath
