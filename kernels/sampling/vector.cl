// Three floats as a struct of scalars: PoCL vectorises these across work-items, float3 values it
// does not.
#pragma once

#include "shared/inline.h"

typedef struct {
    float x, y, z;
} Vec3;

INLINE Vec3 vec3(const float x, const float y, const float z) {
    Vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

INLINE Vec3 add3(const Vec3 a, const Vec3 b) {
    return vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

INLINE Vec3 sub3(const Vec3 a, const Vec3 b) {
    return vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

INLINE Vec3 mul3(const Vec3 a, const Vec3 b) {
    return vec3(a.x * b.x, a.y * b.y, a.z * b.z);
}

INLINE Vec3 scale3(const Vec3 a, const float s) {
    return vec3(a.x * s, a.y * s, a.z * s);
}

// a + b * s
INLINE Vec3 madd3(const Vec3 a, const Vec3 b, const float s) {
    return vec3(fma(b.x, s, a.x), fma(b.y, s, a.y), fma(b.z, s, a.z));
}

INLINE float dot3(const Vec3 a, const Vec3 b) {
    return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
}

INLINE Vec3 cross3(const Vec3 a, const Vec3 b) {
    return vec3(
        fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x)));
}

INLINE Vec3 normalize3(const Vec3 a) {
    return scale3(a, 1.0f / sqrt(dot3(a, a)));
}

INLINE float max_component3(const Vec3 a) {
    return max(a.x, max(a.y, a.z));
}

INLINE Vec3 select3(const int condition, const Vec3 yes, const Vec3 no) {
    return vec3(condition ? yes.x : no.x, condition ? yes.y : no.y, condition ? yes.z : no.z);
}

// Plane k of a group of planes (shared/path.h). Every kernel reads `stride` and its other
// parameters before its guard: behind it the load would be conditional, and PoCL would gather what
// lies side by side.
#define PLANE(group, k) ((group) + (k)*stride)

INLINE Vec3 load3(global const float* plane, const size_t stride, const size_t slot) {
    return vec3(plane[slot], plane[stride + slot], plane[2 * stride + slot]);
}

INLINE void store3(global float* plane, const size_t stride, const size_t slot, const Vec3 v) {
    plane[slot] = v.x;
    plane[stride + slot] = v.y;
    plane[2 * stride + slot] = v.z;
}

// An orthonormal frame around a unit normal (Duff et al. 2017), branch-free and defined at n.z =
// -1.
typedef struct {
    Vec3 s, t, n;
} Frame;

INLINE Frame frame_around(const Vec3 n) {
    const float sign = copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    Frame f;
    f.s = vec3(fma(sign * n.x * n.x, a, 1.0f), sign * b, -sign * n.x);
    f.t = vec3(b, fma(n.y * n.y, a, sign), -n.y);
    f.n = n;
    return f;
}

INLINE Vec3 to_local(const Frame f, const Vec3 v) {
    return vec3(dot3(v, f.s), dot3(v, f.t), dot3(v, f.n));
}

INLINE Vec3 to_world(const Frame f, const Vec3 v) {
    return madd3(madd3(scale3(f.s, v.x), f.t, v.y), f.n, v.z);
}
