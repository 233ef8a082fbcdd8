// Eight triangles against one ray, watertight [Woop 2013].
//
// Each vertex is moved to the ray's origin and sheared so that the ray becomes the z axis; the
// origin is then inside the projected triangle where the three edge functions agree in sign. Zero
// counts as inside, and no edge function has the wrong sign (difference_of_products), from
// whichever of its two triangles a shared edge is seen. Hence no ray slips between two triangles,
// and the paper's fallback to double, which asks for the exact sign, is not needed.
#pragma once

#include "geometry/ray.cl"
#include "shared/bvh.h"
#include "shared/inline.h"

// The ray as the triangle test wants it: axes renamed so that z is the direction's largest part.
typedef struct {
    float ox, oy, oz;  // origin, in the renamed axes
    float sx, sy, sz;  // shear: -d.x / d.z, -d.y / d.z, 1 / d.z
    int kx, ky, kz;    // where the axes are found in a vertex of a block: axis * 8
} ShearedRay;

INLINE ShearedRay shear_ray(const Ray* of) {
    const Vec3 o = of->origin;
    const Vec3 d = of->direction;
    const int z_wins = fabs(d.z) >= max(fabs(d.x), fabs(d.y));
    const int y_wins = !z_wins && fabs(d.y) >= fabs(d.x);
    ShearedRay ray;
    ray.kx = z_wins ? 0 : (y_wins ? 16 : 8);
    ray.ky = z_wins ? 8 : (y_wins ? 0 : 16);
    ray.kz = z_wins ? 16 : (y_wins ? 8 : 0);
    ray.ox = z_wins ? o.x : (y_wins ? o.z : o.y);
    ray.oy = z_wins ? o.y : (y_wins ? o.x : o.z);
    ray.oz = z_wins ? o.z : (y_wins ? o.y : o.x);
    ray.sz = 1.0f / (z_wins ? d.z : (y_wins ? d.y : d.x));
    ray.sx = -ray.sz * (z_wins ? d.x : (y_wins ? d.z : d.y));
    ray.sy = -ray.sz * (z_wins ? d.y : (y_wins ? d.x : d.z));
    return ray;
}

// a b - c d within 1.5 ulp [Jeannerod 2013]. A difference of rounded products is off by an ulp of
// the products, which in a sliver is much of what is left: its distance was off by up to 2^-24
// length^2 / height, which exceeds RAY_OFFSET, and rays that left a sliver met it again. The sign
// is never wrong, whatever underflows: rounding is monotonic, so the two fma compare as a b and c d
// do, or equal.
INLINE float8
difference_of_products(const float8 a, const float8 b, const float8 c, const float8 d) {
    const float8 rounded = c * d;
    return fma(a, b, -rounded) - fma(c, d, -rounded);
}

// One corner of eight triangles.
typedef struct {
    float8 x, y, z;
} Corners;

// Lanes where the z axis meets the triangle a b c, sheared and moved to the ray's origin, at t > 0
// (-1), and where: distances, barycentrics of corners 1 and 2.
INLINE int8 intersect_sheared(
    const Corners a,
    const Corners b,
    const Corners c,
    const float8 sz,
    float8* t,
    float8* u,
    float8* v) {
    // of the edges opposite corners 0, 1, 2
    const float8 edge_a = difference_of_products(c.x, b.y, c.y, b.x);
    const float8 edge_b = difference_of_products(a.x, c.y, a.y, c.x);
    const float8 edge_c = difference_of_products(b.x, a.y, b.y, a.x);
    const float8 lowest = min(edge_a, min(edge_b, edge_c));
    const float8 highest = max(edge_a, max(edge_b, edge_c));
    const float8 det = edge_a + edge_b + edge_c;  // where the signs agree, 0 only if all three are
    const float8 inverse = 1.0f / det;
    *t = (edge_a * a.z + edge_b * b.z + edge_c * c.z) * (inverse * sz);
    *u = edge_b * inverse;
    *v = edge_c * inverse;
    return ((lowest >= 0.0f) | (highest <= 0.0f)) & (det != 0.0f) & (*t > 0.0f);
}

// Lanes hit with 0 < t <= t_max (-1), and where: distances, barycentrics of corners 1 and 2.
INLINE int8 intersect_block(
    global const TriangleBlock* block,
    const ShearedRay* ray,
    const float t_max,
    float8* t,
    float8* u,
    float8* v) {
    global const float* first = &block->vertices[0][0][0];
    global const float* second = &block->vertices[1][0][0];
    global const float* third = &block->vertices[2][0][0];
    Corners a, b, c;
    a.z = vload8(0, first + ray->kz) - ray->oz;
    b.z = vload8(0, second + ray->kz) - ray->oz;
    c.z = vload8(0, third + ray->kz) - ray->oz;
    a.x = fma(a.z, (float8)(ray->sx), vload8(0, first + ray->kx) - ray->ox);
    a.y = fma(a.z, (float8)(ray->sy), vload8(0, first + ray->ky) - ray->oy);
    b.x = fma(b.z, (float8)(ray->sx), vload8(0, second + ray->kx) - ray->ox);
    b.y = fma(b.z, (float8)(ray->sy), vload8(0, second + ray->ky) - ray->oy);
    c.x = fma(c.z, (float8)(ray->sx), vload8(0, third + ray->kx) - ray->ox);
    c.y = fma(c.z, (float8)(ray->sy), vload8(0, third + ray->ky) - ray->oy);
    return intersect_sheared(a, b, c, (float8)(ray->sz), t, u, v) & (*t <= t_max);
}
