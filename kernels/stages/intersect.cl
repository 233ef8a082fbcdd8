// Finds the closest triangle along every ray.
// reads: rays, bvh    writes: hits
// One work-item a slot.

#include "geometry/bvh.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"

kernel void intersect(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const BvhNode* restrict nodes,
    global const TriangleBlock* restrict blocks,
    global const float* restrict rays,
    global float* restrict hits) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    if (as_int(PLANE(hits, HIT_PRIMITIVE)[slot]) == HIT_IDLE) return;
    const Hit hit = closest_hit(
        nodes, blocks, PLANE(rays, RAY_ORIGIN_X)[slot], PLANE(rays, RAY_ORIGIN_Y)[slot],
        PLANE(rays, RAY_ORIGIN_Z)[slot], PLANE(rays, RAY_DIRECTION_X)[slot],
        PLANE(rays, RAY_DIRECTION_Y)[slot], PLANE(rays, RAY_DIRECTION_Z)[slot], INFINITY);
    PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(hit.primitive);
    PLANE(hits, HIT_T)[slot] = hit.t;
    PLANE(hits, HIT_U)[slot] = hit.u;
    PLANE(hits, HIT_V)[slot] = hit.v;
}
