// Boundaries that transmit in part. With t = transmission and m = metallic at the point, glTF's
// mixture [glTF 2.0, section 3.9.6; KHR_materials_transmission]
//   (1 - m) (specular layer over ((1 - t) diffuse + t transmitted)) + m metal
// is a boundary of weight t (1 - m), and with the rest of the weight an opaque surface, without
// transmission and of metallic m / (1 - t (1 - m)). A path meets one of the two.
#pragma once

#include "sampling/rng.cl"
#include "shared/inline.h"

// [1] The boundary's weight.
INLINE float boundary_share(const float transmission, const float metallic) {
    return transmission * (1.0f - metallic);
}

// Whether the ray of this key (share_key of sampling/dimensions.cl) meets the boundary, not the
// opaque surface, at the triangle that it hit.
INLINE int meets_boundary(const uint key, const int primitive, const float share) {
    return unit_float(hash_pair(key, (uint)primitive)) < share;
}
