// Microfacet reflection with the GGX distribution and height-correlated Smith masking (glTF 2.0,
// appendix B.3.2). Directions are in the shading frame, leaving the surface; m is the half-vector.
// alpha = roughness^2.
#pragma once

#include "sampling/warp.cl"
#include "shared/inline.h"

// Below this the lobe is a mirror: D loses its digits (relative error 8 % in single precision by
// the cosine form).
#define MIRROR_ALPHA 1e-3f

// D(m) [1/sr] [Walter 2007, eq. 33] with sin^2 taken from x and y: 1 - cos^2 cancels at small
// alpha.
INLINE float ggx_distribution(const Vec3 m, const float alpha) {
    const float alpha2 = alpha * alpha;
    const float d = fma(alpha2, m.z * m.z, fma(m.x, m.x, m.y * m.y));
    return alpha2 / (PI_F * d * d);
}

// sqrt(alpha^2 + (1 - alpha^2) cos^2) = cos * sqrt(1 + alpha^2 tan^2), finite at cos = 0.
INLINE float ggx_smith_root(const float cosine, const float alpha) {
    const float alpha2 = alpha * alpha;
    return sqrt(fma((1.0f - alpha2) * cosine, cosine, alpha2));
}

// D V cos(wi), F left out; V = G / (4 cos cos) [Heitz 2014, eq. 99].
INLINE float ggx_eval(const Vec3 wo, const Vec3 wi, const Vec3 m, const float alpha) {
    const float visibility =
        0.5f / fma(wi.z, ggx_smith_root(wo.z, alpha), wo.z * ggx_smith_root(wi.z, alpha));
    return ggx_distribution(m, alpha) * visibility * wi.z;
}

// pdf_w [1/sr] of ggx_sample: D_v(m) / (4 wo.m) = D G1 / (4 cos wo) [Heitz 2018, eq. 17].
INLINE float ggx_pdf_w(const Vec3 wo, const Vec3 m, const float alpha) {
    return ggx_distribution(m, alpha) / (2.0f * (wo.z + ggx_smith_root(wo.z, alpha)));
}

// A half-vector of the normals visible from wo [Dupuy & Benyoub 2023, listing 3].
INLINE Vec3 ggx_sample(const Vec3 wo, const float alpha, const Sample2 u) {
    const Vec3 stretched = normalize3(vec3(alpha * wo.x, alpha * wo.y, wo.z));
    const float z = fma(1.0f - u.u, 1.0f + stretched.z, -stretched.z);
    const float r = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const SineCosine phi = sincos_2pi(u.v);
    const Vec3 h = add3(vec3(r * phi.cosine, r * phi.sine, z), stretched);
    return normalize3(
        vec3(alpha * h.x, alpha * h.y, max(h.z, 1e-18f)));  // whose square is a normal number
}
