// Materials and bodies that enclose media.
#pragma once

#include "support/scenes.h"

#include <cmath>

namespace wavepath {

// A smooth dielectric.
inline Material glass(double ior, const Medium& medium = {}) {
    Material material = boundary_of(medium);
    material.boundary = Boundary::dielectric;
    material.ior = static_cast<float>(ior);
    material.roughness = 0;
    return material;
}

// Coefficients of one extinction and an albedo a channel: three media in one render.
inline Medium medium_of(double sigma_t, const Rgb& albedos, double g = 0) {
    Medium medium = medium_of(sigma_t, 0, g);
    for (std::size_t c = 0; c < 3; ++c) {
        medium.sigma_s[c] = static_cast<float>(sigma_t * albedos[c]);
        medium.sigma_a[c] = static_cast<float>(sigma_t * (1.0 - albedos[c]));
    }
    return medium;
}

// A plate of thickness 1 below z = 0, so wide that its sides are nowhere to be seen.
inline void add_slab(Scene& scene, const Medium& medium, double half_width = 40) {
    add_box(
        scene, boundary_of(medium), {-half_width, -half_width, -1}, {half_width, half_width, 0},
        Facing::outward);
}

// A cube of side 1 below z = 0 whose four upright sides are mirrors: by reflection an infinite
// plate.
inline void add_mirrored_slab(Scene& scene, const Medium& medium) {
    add_box(scene, boundary_of(medium), {-0.5, -0.5, -1}, {0.5, 0.5, 0}, Facing::outward);
    split_off(scene, 12, metal(grey(1), 0));  // behind the faces of constant z
}

// What stands right below a plate of mirrors. It is wider than the plate: what leaves by the gap is
// nothing.
inline void add_floor(Scene& scene, const Material& material) {
    add_square(scene, material, {0, 0, -1.0001}, {0, 0, 1}, 3);
}

// Looks at a plate's top under cos = mu, from a plane above it; beside the diagonal, on which two
// triangles meet.
inline Camera along(double mu) {
    const double sine = std::sqrt(1 - mu * mu);
    return orthographic({0.1 + 2 * sine, 0.03, 2 * mu}, {0.1, 0.03, 0}, 0.01);
}

}  // namespace wavepath
