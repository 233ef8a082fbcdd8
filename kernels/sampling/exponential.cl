// exp and log of our own: the builtins keep PoCL from vectorising and differ between
// implementations. Coefficients of Cephes' expf and logf (Moshier 1992), relative error below 2e-7.
#pragma once

#include "shared/inline.h"

#define LN2_HIGH 0.693359375f  // and what is left of ln 2: products with small integers are exact
#define LN2_LOW -2.12194440e-4f

// exp(-x) for x >= 0; 0 from 87 on, where single precision ends.
INLINE float exp_minus(const float x) {
    const float y = -min(x, 87.0f);
    const int n = (int)(fma(y, 1.44269504f, -0.5f));  // towards zero: the nearest integer
    const float r = fma((float)n, -LN2_LOW, fma((float)n, -LN2_HIGH, y));
    float p = fma(r, 1.9875691500e-4f, 1.3981999507e-3f);
    p = fma(p, r, 8.3334519073e-3f);
    p = fma(p, r, 4.1665795894e-2f);
    p = fma(p, r, 1.6666665459e-1f);
    p = fma(p, r, 5.0000001201e-1f);
    p = fma(p * r, r, r) + 1.0f;
    return x >= 87.0f ? 0.0f : p * as_float((127 + n) << 23);
}

// -log(x) for x in (0, 1], a normal number.
INLINE float minus_log(const float x) {
    const int bits = as_int(x);
    // the mantissa in [1/sqrt 2, sqrt 2)
    const int n = (bits - 0x3f3504f3) >> 23;
    const float r = as_float(bits - (n << 23)) - 1.0f;
    const float r2 = r * r;
    float p = fma(r, 7.0376836292e-2f, -1.1514610310e-1f);
    p = fma(p, r, 1.1676998740e-1f);
    p = fma(p, r, -1.2420140846e-1f);
    p = fma(p, r, 1.4249322787e-1f);
    p = fma(p, r, -1.6668057665e-1f);
    p = fma(p, r, 2.0000714765e-1f);
    p = fma(p, r, -2.4999993993e-1f);
    p = fma(p, r, 3.3333331174e-1f);
    p = fma(p * r, r2, fma(-0.5f, r2, (float)n * LN2_LOW));
    return -fma((float)n, LN2_HIGH, r + p);
}

// -log(1 - x) for x in [0, 1), all its digits for small x.
INLINE float minus_log_1_minus(const float x) {
    const float series = fma(fma(fma(fma(x, 0.2f, 0.25f), x, 1.0f / 3.0f), x, 0.5f), x * x, x);
    return x < 0.02f ? series : minus_log(1.0f - x);
}

// (1 - exp(-x)) / x for x >= 0, 1 at 0: what of a medium's emission reaches the end of a segment.
INLINE float mean_of_exp_minus(const float x) {
    const float series = fma(fma(fma(x, -1.0f / 24.0f, 1.0f / 6.0f), x, -0.5f), x, 1.0f);
    return x < 0.03f ? series : (1.0f - exp_minus(x)) / x;
}
