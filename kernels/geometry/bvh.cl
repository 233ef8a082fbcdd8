// Closest hit and any hit of a ray in the 8-wide BVH: eight boxes or eight triangles a step, in one
// work-item, because a traversal loop is what PoCL's vectoriser leaves scalar
// (docs/design/intersect.md says what else was tried). A CPU takes many rays at once where the
// scene is large, geometry/ray_stream.cl, or small, geometry/ray_packet.cl.
#pragma once

#include "geometry/ray.cl"
#include "geometry/simd.cl"
#include "geometry/surface_texture.cl"
#include "geometry/triangle.cl"
#include "shared/features.h"
#include "shared/path.h"

typedef struct {
    float t;        // in lengths of the ray's direction
    float u, v;     // barycentrics of corners 1 and 2
    int primitive;  // triangle id in scene order, -1: none
} Hit;

INLINE void store_hit(global float* hits, const size_t stride, const size_t slot, const Hit* hit) {
    PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(hit->primitive);
    PLANE(hits, HIT_T)[slot] = hit->t;
    PLANE(hits, HIT_U)[slot] = hit->u;
    PLANE(hits, HIT_V)[slot] = hit->v;
}

// A ray against slabs: t = plane * inverse + near (or far). The unit cube lies within 0.5 of the
// origin, so everything in it is at most reach = max|o| + 0.5 away along an axis. Rounding moves a
// slab by at most 4 ulp of that (inverse, product, fma), and the sheared vertices of the triangle
// test by 4 more; near bounds come nearer and far ones go farther by 16 ulp of it. So no box is
// missed whose triangle the triangle test would hit, and it costs nothing a node. Boxes outside the
// unit cube are wider by what rounding of their own coordinates moves (prepare/bvh_builder.cpp).
typedef struct {
    float ix, iy, iz;  // 1 / direction, finite
    float near_x, near_y, near_z;
    float far_x, far_y, far_z;
    int row_x, row_y,
        row_z;  // where the bounds first met begin in BvhNode::bounds; ^ 8: the others
} SlabRay;

INLINE SlabRay slab_ray(const Ray* ray) {
    const Vec3 o = ray->origin;
    const float reach = max(fabs(o.x), max(fabs(o.y), fabs(o.z))) + 0.5f;
    const float slack = 0x1p-20f * reach;
    SlabRay slabs;
    slabs.ix = safe_reciprocal(ray->direction.x);
    slabs.iy = safe_reciprocal(ray->direction.y);
    slabs.iz = safe_reciprocal(ray->direction.z);
    slabs.near_x = -o.x * slabs.ix - slack * fabs(slabs.ix);
    slabs.near_y = -o.y * slabs.iy - slack * fabs(slabs.iy);
    slabs.near_z = -o.z * slabs.iz - slack * fabs(slabs.iz);
    slabs.far_x = -o.x * slabs.ix + slack * fabs(slabs.ix);
    slabs.far_y = -o.y * slabs.iy + slack * fabs(slabs.iy);
    slabs.far_z = -o.z * slabs.iz + slack * fabs(slabs.iz);
    slabs.row_x = slabs.ix < 0.0f ? 8 : 0;
    slabs.row_y = slabs.iy < 0.0f ? 24 : 16;
    slabs.row_z = slabs.iz < 0.0f ? 40 : 32;
    return slabs;
}

// Which children's boxes the ray crosses in [t_min, t_max] (-1), and where it enters them. A box
// entered at t_max itself counts: what it holds may lie at the same distance and have a lower id.
INLINE int8 intersect_node(
    global const BvhNode* node,
    const SlabRay* ray,
    const float t_min,
    const float t_max,
    float8* t_near) {
    global const float* rows = &node->bounds[0][0][0];
    const float8 ix = ray->ix;
    const float8 iy = ray->iy;
    const float8 iz = ray->iz;
    const float8 near_x = fma(vload8(0, rows + ray->row_x), ix, (float8)(ray->near_x));
    const float8 near_y = fma(vload8(0, rows + ray->row_y), iy, (float8)(ray->near_y));
    const float8 near_z = fma(vload8(0, rows + ray->row_z), iz, (float8)(ray->near_z));
    const float8 far_x = fma(vload8(0, rows + (ray->row_x ^ 8)), ix, (float8)(ray->far_x));
    const float8 far_y = fma(vload8(0, rows + (ray->row_y ^ 8)), iy, (float8)(ray->far_y));
    const float8 far_z = fma(vload8(0, rows + (ray->row_z ^ 8)), iz, (float8)(ray->far_z));
    *t_near = max(max(near_x, near_y), max(near_z, (float8)(t_min)));
    return *t_near <= min(min(far_x, far_y), min(far_z, (float8)(t_max)));
}

// Where a ray begins among the triangles it meets, which follow one another by distance, then id:
// behind the last one it passed, so that none is met twice and none left out.
#define STARTS_BEHIND (HAS_PASSAGES || HAS_CONTACTS)
typedef struct {
    float t;
    int primitive;
} RayStart;

INLINE RayStart ray_start(const float t, const int primitive) {
    RayStart start;
    start.t = t;
    start.primitive = primitive;
    return start;
}

INLINE RayStart at_origin(void) {
    return ray_start(0.0f, -1);
}

// Keeps the closest of the block's hits. At equal distance the lowest id wins, so that the order of
// the tree decides nothing.
INLINE void closest_in_block(
    global const TriangleBlock* block,
    const ShearedRay* ray,
    const RayStart start,
    const Cover* cover,
    Hit* hit) {
    float8 t, u, v;
    uint lanes = lane_mask(intersect_block(block, ray, hit->t, &t, &u, &v));
    if (lanes == 0) return;
    float ts[8], us[8], vs[8];
    vstore8(t, 0, ts);
    vstore8(u, 0, us);
    vstore8(v, 0, vs);
    do {
        const uint lane = 31u - clz(lanes);
        lanes ^= 1u << lane;
        const uint entry = block->primitives[lane];
        const int primitive = (int)(HAS_ALPHA ? entry & ~BVH_HOLES : entry);
        if (STARTS_BEHIND &&
            (ts[lane] < start.t || (ts[lane] == start.t && primitive <= start.primitive)))
            continue;
        if (ts[lane] < hit->t || (ts[lane] == hit->t && primitive < hit->primitive)) {
            if (HAS_ALPHA && (entry & BVH_HOLES) != 0 &&
                !stops_ray(cover, primitive, us[lane], vs[lane]))
                continue;
            hit->t = ts[lane];
            hit->u = us[lane];
            hit->v = vs[lane];
            hit->primitive = primitive;
        }
    } while (lanes != 0);
}

INLINE int any_in_block(
    global const TriangleBlock* block,
    const ShearedRay* ray,
    const Cover* cover,
    const float t_max) {
    float8 t, u, v;
    uint lanes = lane_mask(intersect_block(block, ray, t_max, &t, &u, &v) & (t < t_max));
    if (!HAS_ALPHA || lanes == 0) return lanes != 0;
    float us[8], vs[8];
    vstore8(u, 0, us);
    vstore8(v, 0, vs);
    while (lanes != 0) {
        const uint lane = 31u - clz(lanes);
        lanes ^= 1u << lane;
        const uint entry = block->primitives[lane];
        if ((entry & BVH_HOLES) == 0 ||
            stops_ray(cover, (int)(entry & ~BVH_HOLES), us[lane], vs[lane]))
            return 1;
    }
    return 0;
}

// The closest triangle behind `start` and before the end of the ray that stops the ray: the nearest
// child is entered, the others wait with their distances and are dropped when a hit has come
// nearer. Not inlined: PoCL would give every work-item of a group a stack of its own, where one
// serves all in turn and stays in the cache.
Hit closest_hit(const Tree tree, const Ray* ray, const RayStart start, const Cover* cover) {
    const SlabRay slabs = slab_ray(ray);
    const ShearedRay sheared = shear_ray(ray);
    Hit hit = {end_of_ray(ray), 0.0f, 0.0f, -1};
    uint waiting[BVH_STACK];
    float waiting_t[BVH_STACK];
    int top = 0;
    uint current = 0;
    for (;;) {
        uint lanes = 0;
        if (current & BVH_LEAF) {
            closest_in_block(tree.blocks + (current & ~BVH_LEAF), &sheared, start, cover, &hit);
        } else {
            float8 t_near;
            lanes = lane_mask(intersect_node(
                tree.nodes + current, &slabs, STARTS_BEHIND ? start.t : 0.0f, hit.t, &t_near));
            if (lanes != 0) {
                float ts[8];
                vstore8(t_near, 0, ts);
                global const uint* children = tree.nodes[current].children;
                uint lane = 31u - clz(lanes);
                lanes ^= 1u << lane;
                uint nearest = children[lane];
                float nearest_t = ts[lane];
                while (lanes != 0) {
                    lane = 31u - clz(lanes);
                    lanes ^= 1u << lane;
                    const uint other = children[lane];
                    const float other_t = ts[lane];
                    const int closer = other_t < nearest_t;
                    waiting[top] = closer ? nearest : other;
                    waiting_t[top] = closer ? nearest_t : other_t;
                    ++top;
                    nearest = closer ? other : nearest;
                    nearest_t = closer ? other_t : nearest_t;
                }
                current = nearest;
                continue;
            }
        }
        do {
            if (top == 0) return hit;
            --top;
        } while (waiting_t[top] > hit.t);
        current = waiting[top];
    }
}

// 1 if a triangle lies in (0, t_max) and stops the ray. Any order of the children will do; not
// inlined, as above.
int any_hit(const Tree tree, const Ray* ray, const Cover* cover) {
    const SlabRay slabs = slab_ray(ray);
    const ShearedRay sheared = shear_ray(ray);
    const float end = end_of_ray(ray);
    uint waiting[BVH_STACK];
    int top = 0;
    uint current = 0;
    for (;;) {
        if (current & BVH_LEAF) {
            if (any_in_block(tree.blocks + (current & ~BVH_LEAF), &sheared, cover, end)) return 1;
        } else {
            float8 t_near;
            uint lanes =
                lane_mask(intersect_node(tree.nodes + current, &slabs, 0.0f, end, &t_near));
            global const uint* children = tree.nodes[current].children;
            while (lanes != 0) {
                const uint lane = 31u - clz(lanes);
                lanes ^= 1u << lane;
                waiting[top] = children[lane];
                ++top;
            }
        }
        if (top == 0) return 0;
        --top;
        current = waiting[top];
    }
}
