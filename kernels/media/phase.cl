// Where a medium scatters light to: Henyey and Greenstein's phase function (1941),
//     p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)),
// g the mean cosine between the directions of travel. Both forms below are free of the
// cancellations at g -> 0 and |g| -> 1: with a = |g| and d = 1 - cos (g < 0: 1 + cos),
//     1 + g^2 - 2 g cos = (1 - a)^2 + 2 a d,
// and the inverse of the cumulative density is
//     d = 2 (1 - a)^2 (1 - u)(1 + a u) / (1 - a + 2 a u)^2.
#pragma once

#include "sampling/warp.cl"
#include "shared/features.h"
#include "shared/inline.h"

#define INV_4PI_F 0.0795774715459477f

typedef struct {
    Vec3 wi;
    float weight;  // p / pdf_w
    float pdf_w;   // [1/sr]
} PhaseSample;

INLINE float hg_density(const float a, const float d) {
    const float root = fma(1.0f - a, 1.0f - a, 2.0f * a * d);
    return INV_4PI_F * (1.0f - a) * (1.0f + a) / (root * sqrt(root));
}

// p [1/sr] between two directions of travel. d = |difference|^2 / 2 keeps its digits where a cosine
// near 1 has none left.
INLINE float phase_eval(const float g, const Vec3 direction, const Vec3 wi) {
    const Vec3 step = madd3(wi, direction, g < 0.0f ? 1.0f : -1.0f);
    return hg_density(fabs(g), 0.5f * dot3(step, step));
}

// pdf_w [1/sr] of phase_sample where the phase function is `value`.
INLINE float phase_pdf_w(const float value) {
    return PHASE_DIRECTIONS ? value : INV_4PI_F;
}

INLINE PhaseSample phase_sample(const float g, const Vec3 direction, const Sample2 u) {
    PhaseSample s;
    if (!PHASE_DIRECTIONS) {
        s.wi = sample_sphere(u);
        s.pdf_w = INV_4PI_F;
        s.weight = phase_eval(g, direction, s.wi) / INV_4PI_F;
        return s;
    }
    const float a = fabs(g);
    const float width = (1.0f - a) / fma(2.0f * a, u.u, 1.0f - a);
    const float d = min(2.0f * width * width * (1.0f - u.u) * fma(a, u.u, 1.0f), 2.0f);
    const float sine = sqrt(d * (2.0f - d));
    const SineCosine phi = sincos_2pi(u.v);
    const float cosine = g < 0.0f ? d - 1.0f : 1.0f - d;
    s.wi = normalize3(
        to_world(frame_around(direction), vec3(sine * phi.cosine, sine * phi.sine, cosine)));
    s.pdf_w = hg_density(a, d);
    s.weight = 1.0f;
    return s;
}
