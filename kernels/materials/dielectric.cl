// The smooth interface of two dielectrics.
#pragma once

#include "sampling/vector.cl"
#include "shared/inline.h"

typedef struct {
    float reflectance;  // [1] unpolarised mean
    float cosine;       // of the refracted ray; 0 at total reflection
} Interface;

// Fresnel's equations for a ray that arrives under `cosine` > 0 from index ior_i, towards ior_t.
INLINE Interface fresnel_interface(const float cosine, const float ior_i, const float ior_t) {
    const float eta = ior_i / ior_t;
    const float sine2 = eta * eta * fma(-cosine, cosine, 1.0f);
    const float beyond = sqrt(max(0.0f, 1.0f - sine2));
    const float s = (ior_i * cosine - ior_t * beyond) / fma(ior_i, cosine, ior_t * beyond);
    const float p = (ior_t * cosine - ior_i * beyond) / fma(ior_t, cosine, ior_i * beyond);
    Interface r;
    r.reflectance = sine2 >= 1.0f ? 1.0f : 0.5f * fma(s, s, p * p);
    r.cosine = beyond;
    return r;
}
