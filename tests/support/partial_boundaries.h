// Boundaries that transmit in part, and textures over boxes.
#pragma once

#include "support/images.h"
#include "support/media.h"

namespace wavepath {

// The same boundary with transmission t and metallic m.
inline Material in_part(Material boundary, double t, double m = 0) {
    boundary.transmission = static_cast<float>(t);
    boundary.metallic = static_cast<float>(m);
    return boundary;
}

// Texture coordinates u = x, v = y.
inline void lay_out_flat(Primitive& primitive) {
    for (std::size_t i = 0; i < primitive.positions.size(); i += 3)
        for (std::size_t k = 0; k < 2; ++k) primitive.uvs[0].push_back(primitive.positions[i + k]);
}

// A box whose top, laid out flat, has a material of its own. Materials: bottom, top, sides.
inline void add_box_with_top(
    Scene& scene, const Material& box, const Material& top, const Vec3d& low, const Vec3d& high) {
    add_box(scene, box, low, high, Facing::outward);
    split_off(scene, 6, top);
    split_off(scene, 6, box);
    lay_out_flat(scene.primitives[scene.primitives.size() - 2]);
}

// So dense that what enters is not seen again, yet clear over what floats round
// (docs/stability.md).
inline Medium black() {
    Medium medium;
    medium.sigma_a = grey(20);
    return medium;
}

}  // namespace wavepath
