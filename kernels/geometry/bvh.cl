// Closest hit and any hit of one ray in the 8-wide BVH: eight boxes or eight triangles a step, in one work-item, because
// a traversal loop is what PoCL's vectoriser leaves scalar (docs/profiling.md has what was tried).
#pragma once

#include "geometry/triangle.cl"

typedef struct {
    float t;        // in lengths of the ray's direction
    float u, v;     // barycentrics of corners 1 and 2
    int primitive;  // triangle id in scene order, -1: none
} Hit;

// Lanes of a comparison as bits. movmskps is one instruction where the compiler knows it.
#if defined(__AVX__) && defined(__has_builtin)
#if __has_builtin(__builtin_ia32_movmskps256)
#define HAS_MOVMSKPS 1
#endif
#endif
uint lane_mask(int8 lanes) {
#ifdef HAS_MOVMSKPS
    return (uint)__builtin_ia32_movmskps256(as_float8(lanes));
#else
    const int8 bits = lanes & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 quarter = bits.lo | bits.hi;
    const int2 pair = quarter.lo | quarter.hi;
    return (uint)(pair.x | pair.y);
#endif
}

// A ray against slabs: t = plane * inverse + near (or far). Near bounds are moved towards the ray's start and far ones
// away from it by `slack`, which exceeds the rounding of the slab test and of the sheared vertices together: each is
// at most 4 ulp of the distance along the axis, at most max|o| + 0.5 in the normalised scene. So a box is never missed
// whose triangle the triangle test would hit, and the margin costs nothing per node.
typedef struct {
    float ix, iy, iz;           // 1 / direction, finite
    float near_x, near_y, near_z;
    float far_x, far_y, far_z;
    int row_x, row_y, row_z;    // which of the 6 rows of BvhNode::bounds comes first
} SlabRay;

// 1/d with |d| raised to 1e-18: an axis-parallel ray gets finite slabs instead of 0 * infinity = NaN.
float safe_reciprocal(float d) { return 1.0f / (fabs(d) < 1e-18f ? copysign(1e-18f, d) : d); }

SlabRay slab_ray(float ox, float oy, float oz, float dx, float dy, float dz) {
    const float slack = 9.5367432e-7f * (max(fabs(ox), max(fabs(oy), fabs(oz))) + 0.5f);  // 16 ulp
    SlabRay ray;
    ray.ix = safe_reciprocal(dx);
    ray.iy = safe_reciprocal(dy);
    ray.iz = safe_reciprocal(dz);
    ray.near_x = -ox * ray.ix - slack * fabs(ray.ix);
    ray.near_y = -oy * ray.iy - slack * fabs(ray.iy);
    ray.near_z = -oz * ray.iz - slack * fabs(ray.iz);
    ray.far_x = -ox * ray.ix + slack * fabs(ray.ix);
    ray.far_y = -oy * ray.iy + slack * fabs(ray.iy);
    ray.far_z = -oz * ray.iz + slack * fabs(ray.iz);
    ray.row_x = ray.ix < 0.0f ? 8 : 0;
    ray.row_y = ray.iy < 0.0f ? 24 : 16;
    ray.row_z = ray.iz < 0.0f ? 40 : 32;
    return ray;
}

// Children whose box the ray crosses before t_max, and where it enters them.
uint intersect_node(global const BvhNode* node, const SlabRay* ray, float t_max, float8* t_near) {
    global const float* rows = &node->bounds[0][0][0];
    const float8 near_x = fma(vload8(0, rows + ray->row_x), (float8)(ray->ix), (float8)(ray->near_x));
    const float8 near_y = fma(vload8(0, rows + ray->row_y), (float8)(ray->iy), (float8)(ray->near_y));
    const float8 near_z = fma(vload8(0, rows + ray->row_z), (float8)(ray->iz), (float8)(ray->near_z));
    const float8 far_x = fma(vload8(0, rows + (ray->row_x ^ 8)), (float8)(ray->ix), (float8)(ray->far_x));
    const float8 far_y = fma(vload8(0, rows + (ray->row_y ^ 8)), (float8)(ray->iy), (float8)(ray->far_y));
    const float8 far_z = fma(vload8(0, rows + (ray->row_z ^ 8)), (float8)(ray->iz), (float8)(ray->far_z));
    *t_near = max(max(near_x, near_y), max(near_z, (float8)(0.0f)));
    return lane_mask(*t_near <= min(min(far_x, far_y), min(far_z, (float8)(t_max))));
}

Hit closest_hit(
    global const BvhNode* nodes,
    global const TriangleBlock* blocks,
    float ox,
    float oy,
    float oz,
    float dx,
    float dy,
    float dz,
    float t_max) {
    const SlabRay slabs = slab_ray(ox, oy, oz, dx, dy, dz);
    const ShearedRay sheared = shear_ray(ox, oy, oz, dx, dy, dz);
    Hit hit = {t_max, 0.0f, 0.0f, -1};
    uint waiting[BVH_STACK];
    float waiting_t[BVH_STACK];
    int top = 0;
    uint current = 0;
    for (;;) {
        uint lanes = 0;
        if (current & BVH_LEAF) {
            uint block = (current & ~BVH_LEAF) >> 4;
            const uint end = block + (current & 15u);
            for (; block < end; ++block) {
                float8 t, u, v;
                uint hits = lane_mask(intersect_block(blocks + block, &sheared, hit.t, &t, &u, &v));
                if (hits == 0) continue;
                float ts[8], us[8], vs[8];
                vstore8(t, 0, ts);
                vstore8(u, 0, us);
                vstore8(v, 0, vs);
                while (hits != 0) {
                    const uint lane = 31u - clz(hits);
                    hits ^= 1u << lane;
                    const int primitive = (int)blocks[block].primitives[lane];
                    // At equal distance the lowest id wins, whatever the order of the tree.
                    if (ts[lane] < hit.t || (ts[lane] == hit.t && primitive < hit.primitive)) {
                        hit.t = ts[lane];
                        hit.u = us[lane];
                        hit.v = vs[lane];
                        hit.primitive = primitive;
                    }
                }
            }
        } else {
            float8 t_near;
            lanes = intersect_node(nodes + current, &slabs, hit.t, &t_near);
            if (lanes != 0) {
                float ts[8];
                vstore8(t_near, 0, ts);
                global const uint* children = nodes[current].children;
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

// 1 if a triangle lies in (0, t_max).
int any_hit(
    global const BvhNode* nodes,
    global const TriangleBlock* blocks,
    float ox,
    float oy,
    float oz,
    float dx,
    float dy,
    float dz,
    float t_max) {
    const SlabRay slabs = slab_ray(ox, oy, oz, dx, dy, dz);
    const ShearedRay sheared = shear_ray(ox, oy, oz, dx, dy, dz);
    uint waiting[BVH_STACK];
    int top = 0;
    uint current = 0;
    for (;;) {
        if (current & BVH_LEAF) {
            uint block = (current & ~BVH_LEAF) >> 4;
            const uint end = block + (current & 15u);
            for (; block < end; ++block) {
                float8 t, u, v;
                const int8 hits = intersect_block(blocks + block, &sheared, t_max, &t, &u, &v);
                if (lane_mask(hits & (t < t_max)) != 0) return 1;
            }
        } else {
            float8 t_near;
            uint lanes = intersect_node(nodes + current, &slabs, t_max, &t_near);
            global const uint* children = nodes[current].children;
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
