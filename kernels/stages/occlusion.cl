// Traces the pending connections and adds what arrives.
// reads: shadows, bvh    writes: radiances, fates
// One work-item a slot.

#include "geometry/bvh.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void occlusion(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const BvhNode* restrict nodes,
    global const TriangleBlock* restrict blocks,
    global const float* restrict shadows,
    global float* restrict radiances,
    global uchar* restrict fates) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const float t_max = PLANE(shadows, SHADOW_T_MAX)[slot];
    fates[slot] = t_max > 0.0f ? FATE_CONNECTED : 0u;
    if (t_max <= 0.0f) return;
    const int blocked = any_hit(
        nodes, blocks, PLANE(shadows, SHADOW_ORIGIN_X)[slot], PLANE(shadows, SHADOW_ORIGIN_Y)[slot],
        PLANE(shadows, SHADOW_ORIGIN_Z)[slot], PLANE(shadows, SHADOW_DIRECTION_X)[slot],
        PLANE(shadows, SHADOW_DIRECTION_Y)[slot], PLANE(shadows, SHADOW_DIRECTION_Z)[slot], t_max);
    if (blocked) return;
    for (int k = 0; k < 3; ++k) PLANE(radiances, RADIANCE_R + k)[slot] += PLANE(shadows, SHADOW_R + k)[slot];
}
