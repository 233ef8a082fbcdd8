// Schlick's approximation of Fresnel reflectance, as the glTF 2.0 specification prescribes
// (appendix B.3.4).
#pragma once

#include "sampling/vector.cl"
#include "shared/inline.h"

// (1 - cos)^5 [Schlick 1994, eq. 15].
INLINE float schlick_weight(const float cosine) {
    const float x = clamp(1.0f - cosine, 0.0f, 1.0f);
    const float x2 = x * x;
    return x2 * x2 * x;
}

INLINE Vec3 schlick(const Vec3 f0, const float weight) {
    return vec3(
        fma(1.0f - f0.x, weight, f0.x), fma(1.0f - f0.y, weight, f0.y),
        fma(1.0f - f0.z, weight, f0.z));
}
