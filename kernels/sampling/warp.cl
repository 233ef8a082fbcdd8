// Maps from the unit square, and the elementary functions they need: polynomials of our own, since
// the builtins block vectorisation on PoCL and differ between implementations.
#pragma once

#include "sampling/sobol.cl"
#include "sampling/vector.cl"
#include "shared/inline.h"

#define PI_F 3.14159265358979f
#define INV_PI_F 0.318309886183791f

typedef struct {
    float sine, cosine;
} SineCosine;

// sin and cos of 2 pi u, u in [-1, 1]; absolute error below 2e-7. Minimax polynomials on [-1/8,
// 1/8] turns after reduction to the nearest quarter turn.
INLINE SineCosine sincos_2pi(const float u) {
    const float quarters = u * 4.0f;
    const int k = (int)(quarters + (quarters >= 0.0f ? 0.5f : -0.5f));
    const float x = (quarters - (float)k) * 1.57079632679490f;  // [-pi/4, pi/4]
    const float x2 = x * x;
    float s = fma(x2, -1.9515295891e-4f, 8.3321608736e-3f);
    s = fma(s, x2, -1.6666654611e-1f);
    s = fma(s * x2, x, x);
    float c = fma(x2, 2.443315711809948e-5f, -1.388731625493765e-3f);
    c = fma(c, x2, 4.166664568298827e-2f);
    c = fma(c * x2, x2, fma(x2, -0.5f, 1.0f));
    const int odd = k & 1;
    const float sine = odd ? c : s;
    const float cosine = odd ? s : c;
    SineCosine r;
    r.sine = (k & 2) ? -sine : sine;
    r.cosine = ((k + 1) & 2) ? -cosine : cosine;
    return r;
}

// atan2(y, x) / (2 pi) in (-1/2, 1/2]; absolute error below 1e-7 turns. Abramowitz & Stegun 4.4.49
// refitted.
INLINE float atan2_turns(const float y, const float x) {
    const float ax = fabs(x);
    const float ay = max(y, -y);  // not a pair of fabs, which PoCL's SLP pass makes a vector of
    const float larger = max(ax, ay);
    const float z = larger > 0.0f ? min(ax, ay) / larger : 0.0f;
    // reduce [0, 1] to [-(sqrt 2 - 1), sqrt 2 - 1]: atan z = pi/4 + atan((z - 1) / (z + 1))
    const int upper = z > 0.414213562f;
    const float w = upper ? (z - 1.0f) / (z + 1.0f) : z;
    const float w2 = w * w;
    float p = fma(w2, 8.05374449538e-2f, -1.38776856032e-1f);
    p = fma(p, w2, 1.99777106478e-1f);
    p = fma(p, w2, -3.33329491539e-1f);
    float angle = fma(p * w2, w, w) * 0.159154943091895f + (upper ? 0.125f : 0.0f);
    angle = ay > ax ? 0.25f - angle : angle;
    angle = x < 0.0f ? 0.5f - angle : angle;
    return y < 0.0f ? -angle : angle;
}

// acos(z) / pi in [0, 1]; absolute error below 2e-7. The product keeps the digits of 1 - z^2 near
// both ends.
INLINE float acos_half_turns(const float z) {
    return 2.0f * atan2_turns(sqrt(max(0.0f, (1.0f - z) * (1.0f + z))), z);
}

// Cosine-distributed direction about +z, pdf_w = cos / pi: uniform in projected solid angle (notes
// 3, p_mu = 1/pi).
INLINE Vec3 sample_cosine(const Sample2 u) {
    const float r = sqrt(u.u);
    const SineCosine phi = sincos_2pi(u.v);
    return vec3(r * phi.cosine, r * phi.sine, sqrt(max(0.0f, 1.0f - u.u)));
}

// Uniform over the sphere, pdf_w = 1 / (4 pi).
INLINE Vec3 sample_sphere(const Sample2 u) {
    const float z = fma(-2.0f, u.u, 1.0f);
    const float r = sqrt(max(0.0f, 1.0f - z * z));
    const SineCosine phi = sincos_2pi(u.v);
    return vec3(r * phi.cosine, r * phi.sine, z);
}

// Barycentric weights of corners 1 and 2, uniform by area, pdf_a = 1 / area (Turk 1990).
INLINE Sample2 sample_triangle(const Sample2 u) {
    const float r = sqrt(u.u);
    Sample2 b;
    b.u = r * (1.0f - u.v);
    b.v = r * u.v;
    return b;
}
