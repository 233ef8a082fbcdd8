// Eight triangles against one ray, watertight [Woop 2013].
//
// Each vertex is moved to the ray's origin and sheared so that the ray becomes the z axis; the
// origin is then inside the projected triangle where the three edge functions agree in sign. Zero
// counts as inside, and no edge function has the wrong sign (difference_of_products), from
// whichever of its two triangles a shared edge is seen. Hence no ray slips between two triangles,
// and the paper's fallback to double, which asks for the exact sign, is not needed.
#pragma once

#include "shared/bvh.h"
#include "shared/inline.h"

// The ray as the triangle test wants it: axes renamed so that z is the direction's largest part.
typedef struct {
    float ox, oy, oz;  // origin, in the renamed axes
    float sx, sy, sz;  // shear: -d.x / d.z, -d.y / d.z, 1 / d.z
    int kx, ky, kz;    // where the axes are found in a vertex of a block: axis * 8
} ShearedRay;

INLINE ShearedRay shear_ray(
    const float ox,
    const float oy,
    const float oz,
    const float dx,
    const float dy,
    const float dz) {
    const int z_wins = fabs(dz) >= max(fabs(dx), fabs(dy));
    const int y_wins = !z_wins && fabs(dy) >= fabs(dx);
    ShearedRay ray;
    ray.kx = z_wins ? 0 : (y_wins ? 16 : 8);
    ray.ky = z_wins ? 8 : (y_wins ? 0 : 16);
    ray.kz = z_wins ? 16 : (y_wins ? 8 : 0);
    ray.ox = z_wins ? ox : (y_wins ? oz : oy);
    ray.oy = z_wins ? oy : (y_wins ? ox : oz);
    ray.oz = z_wins ? oz : (y_wins ? oy : ox);
    ray.sz = 1.0f / (z_wins ? dz : (y_wins ? dy : dx));
    ray.sx = -ray.sz * (z_wins ? dx : (y_wins ? dz : dy));
    ray.sy = -ray.sz * (z_wins ? dy : (y_wins ? dx : dz));
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

// Lanes where the z axis meets the triangle a b c, sheared and moved to the ray's origin, at t > 0
// (-1), and where: distances, barycentrics of corners 1 and 2.
INLINE int8 intersect_sheared(
    const float8 ax,
    const float8 ay,
    const float8 az,
    const float8 bx,
    const float8 by,
    const float8 bz,
    const float8 cx,
    const float8 cy,
    const float8 cz,
    const float8 sz,
    float8* t,
    float8* u,
    float8* v) {
    // of the edges opposite corners 0, 1, 2
    const float8 edge_a = difference_of_products(cx, by, cy, bx);
    const float8 edge_b = difference_of_products(ax, cy, ay, cx);
    const float8 edge_c = difference_of_products(bx, ay, by, ax);
    const float8 lowest = min(edge_a, min(edge_b, edge_c));
    const float8 highest = max(edge_a, max(edge_b, edge_c));
    const float8 det = edge_a + edge_b + edge_c;  // where the signs agree, 0 only if all three are
    const float8 inverse = 1.0f / det;
    *t = (edge_a * az + edge_b * bz + edge_c * cz) * (inverse * sz);
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
    global const float* a = &block->vertices[0][0][0];
    global const float* b = &block->vertices[1][0][0];
    global const float* c = &block->vertices[2][0][0];
    const float8 az = vload8(0, a + ray->kz) - ray->oz;
    const float8 bz = vload8(0, b + ray->kz) - ray->oz;
    const float8 cz = vload8(0, c + ray->kz) - ray->oz;
    const float8 ax = fma(az, (float8)(ray->sx), vload8(0, a + ray->kx) - ray->ox);
    const float8 ay = fma(az, (float8)(ray->sy), vload8(0, a + ray->ky) - ray->oy);
    const float8 bx = fma(bz, (float8)(ray->sx), vload8(0, b + ray->kx) - ray->ox);
    const float8 by = fma(bz, (float8)(ray->sy), vload8(0, b + ray->ky) - ray->oy);
    const float8 cx = fma(cz, (float8)(ray->sx), vload8(0, c + ray->kx) - ray->ox);
    const float8 cy = fma(cz, (float8)(ray->sy), vload8(0, c + ray->ky) - ray->oy);
    return intersect_sheared(ax, ay, az, bx, by, bz, cx, cy, cz, (float8)(ray->sz), t, u, v) &
           (*t <= t_max);
}
