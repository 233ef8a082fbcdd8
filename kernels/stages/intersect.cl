// Finds the closest triangle along every active ray.
// reads: ray queue, rays, bvh    writes: hits
// One work-item a ray.

#include "geometry/bvh.cl"
#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void intersect(
    constant const RenderParams* restrict params,
    global const QueueSizes* restrict sizes,
    global const uint* restrict queue,
    global const BvhNode* restrict nodes,
    global const TriangleBlock* restrict blocks,
    global const float* restrict rays,
    global float* restrict hits) {
    const uint i = (uint)get_global_id(0);
    if (i >= sizes->active) return;
    const int slot = (int)queue[i];
    const Hit hit = closest_hit(
        nodes, blocks, PLANE(rays, RAY_ORIGIN_X)[slot], PLANE(rays, RAY_ORIGIN_Y)[slot],
        PLANE(rays, RAY_ORIGIN_Z)[slot], PLANE(rays, RAY_DIRECTION_X)[slot],
        PLANE(rays, RAY_DIRECTION_Y)[slot], PLANE(rays, RAY_DIRECTION_Z)[slot], INFINITY);
    PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(hit.primitive);
    PLANE(hits, HIT_T)[slot] = hit.t;
    PLANE(hits, HIT_U)[slot] = hit.u;
    PLANE(hits, HIT_V)[slot] = hit.v;
}
