// Materials and bodies that enclose media.
#pragma once

#include "support/scenes.h"

namespace wavepath {

inline Medium medium_of(double sigma_t, double albedo, double g = 0) {
    Medium medium;
    medium.sigma_a = grey(static_cast<float>(sigma_t * (1 - albedo)));
    medium.sigma_s = grey(static_cast<float>(sigma_t * albedo));
    medium.anisotropy = static_cast<float>(g);
    return medium;
}

// An index-matched boundary: light passes straight.
inline Material boundary_of(const Medium& medium) {
    Material material = lambert(grey(1));
    material.boundary = Boundary::index_matched;
    material.medium = medium;
    return material;
}

// A plate of thickness 1 below z = 0, so wide that its sides are nowhere to be seen.
inline void add_slab(Scene& scene, const Medium& medium, double half_width = 40) {
    add_box(
        scene, boundary_of(medium), {-half_width, -half_width, -1}, {half_width, half_width, 0},
        Facing::outward);
}

}  // namespace wavepath
