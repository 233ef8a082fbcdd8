// Triangles as they are seen from a point, sampled uniformly by solid angle. By area (notes 5) the
// density falls to nothing towards a lamp, and mis leaves those connections to directions, which
// seldom find it.
#pragma once

#include "geometry/attributes.cl"
#include "sampling/warp.cl"
#include "shared/features.h"
#include "shared/inline.h"

// Where directions are aimed at the surroundings of the lamps (lights/guide.cl) and something in
// the scene scatters. Lamps elsewhere look small: there they are sampled by area, which costs less.
#ifndef LIGHTS_BY_SOLID_ANGLE
#define LIGHTS_BY_SOLID_ANGLE (HAS_GUIDE & ((HAS_MEDIA & MEDIA_SCATTER) != 0))
#endif

// A triangle of corners a, b, c.
typedef struct {
    float distance_a, distance_b, distance_c;  // of the corners
    float ab, bc, ca;                          // scalar products of the vectors to them
    float product;                             // of the three distances
    float volume;                              // of the parallelepiped of the three vectors
    float solid_angle;                         // [sr], 0 .. 2 pi
} SeenTriangle;

// x * y as an fma: of the alike factors of a product LLVM's SLP pass makes a vector, and the kernel
// around them stays scalar on PoCL.
INLINE float product_apart(const float x, const float y) {
    return fma(x, y, 0.0f);
}

// Van Oosterom and Strackee 1983, eq. 8.
INLINE SeenTriangle see_triangle(global const float* triangle, const Vec3 from) {
    const Vec3 a = sub3(triangle_corner(triangle, TRIANGLE_CORNERS, 0), from);
    const Vec3 b = sub3(triangle_corner(triangle, TRIANGLE_CORNERS, 1), from);
    const Vec3 c = sub3(triangle_corner(triangle, TRIANGLE_CORNERS, 2), from);
    SeenTriangle s;
    s.distance_a = sqrt(dot3(a, a));
    s.distance_b = sqrt(dot3(b, b));
    s.distance_c = sqrt(dot3(c, c));
    s.ab = dot3(a, b);
    s.bc = dot3(b, c);
    s.ca = dot3(c, a);
    s.product = product_apart(product_apart(s.distance_a, s.distance_b), s.distance_c);
    s.volume = fabs(dot3(a, cross3(b, c)));
    const float rest = fma(s.bc, s.distance_a, fma(s.ca, s.distance_b, s.product));
    s.solid_angle = 4.0f * PI_F * atan2_turns(s.volume, fma(s.ab, s.distance_c, rest));
    return s;
}

// Whether floats tell the solid angle and its parts: the triangle is neither small (some 0.005 sr),
// and as well sampled by area, nor seen from close to its plane, nor so tiny that the square of
// its volume underflows.
INLINE int is_seen_well(const SeenTriangle s) {
    return (s.volume > 1e-2f * s.product) & (s.volume > 1e-18f);
}

// Barycentric weights of corners 1 and 2 of the point in a direction uniform over the solid angle:
// on the arc from b to that point r of the arc from a to c up to which u.u of the solid angle lies
// [Arvo 1995]. r mirrors a at the direction along_a a + along_c c, which follows from half of that
// part without any angle of the triangle [Peters 2021].
INLINE Sample2 sample_seen_triangle(const SeenTriangle s, const Sample2 u) {
    const SineCosine half_part = sincos_2pi(0.25f * INV_PI_F * u.u * s.solid_angle);
    const float distance_ca = product_apart(s.distance_c, s.distance_a);
    const float cos_ca = s.ca / distance_ca;
    const float along_a = fma(
        s.volume, half_part.cosine, -fma(s.bc, s.distance_a, s.ca * s.distance_b) * half_part.sine);
    const float along_c = fma(s.ab, s.distance_c, s.product) * half_part.sine;
    const float on_a = fma(along_c, cos_ca, along_a);
    const float on_c = fma(along_a, cos_ca, along_c);
    const float twice = 2.0f * on_a / fma(along_a, on_a, along_c * on_c);
    const float r_a = fma(twice, along_a, -1.0f);
    const float r_c = twice * along_c;
    const float cos_br =
        fma(r_c * s.bc, s.distance_a, product_apart(r_a * s.ab, s.distance_c)) / s.product;
    const float versine = 1.0f - cos_br;
    const float t = sqrt(u.v * fma(-u.v, versine, 2.0f) / (2.0f - versine));
    // the weights of the unit vectors over their distances, all times the three distances
    const float weight_b = max(fma(versine, t - u.v, 1.0f - t), 0.0f) * distance_ca;
    const float weight_c = r_c * s.distance_a;
    const float weight_ca = fma(max(r_a, 0.0f), s.distance_c, weight_c);
    Sample2 at;
    at.u = weight_b / fma(t * weight_ca, s.distance_b, weight_b);
    at.v = weight_c / weight_ca * (1.0f - at.u);
    return at;
}
