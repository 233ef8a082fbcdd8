// Densities change measure only here [Veach 1997, eq. 8.10].
#pragma once

#include "shared/inline.h"

// pdf_a [1/m^2] of a point seen at squared distance `distance2` under cosine `cos_light` at the
// light, as pdf_w [1/sr].
INLINE float pdf_a_to_w(const float pdf_a, const float distance2, const float cos_light) {
    return pdf_a * distance2 / cos_light;
}

// Power heuristic, beta = 2 [Veach 1997, eq. 9.13], as a ratio so that huge densities do not
// overflow to NaN.
INLINE float power_heuristic(const float pdf, const float other_pdf) {
    const float ratio = other_pdf / pdf;
    return 1.0f / fma(ratio, ratio, 1.0f);
}
