// Starts a window: gives every slot its first unit of work, one before its first sample.
//
// reads: plan
//
// writes: hits, ids, radiances (the sums)
//
// One work-item a slot in use.

#include "geometry/path_state.cl"
#include "sampling/sobol.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"

kernel void assign_units(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const PlanRow* restrict plan,
    global float* restrict hits,
    global uint* restrict ids,
    global float* restrict radiances) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const uint slot = (uint)get_global_id(0);
    if (slot >= slots) return;
    set_hit(hits, stride, slot, HIT_ENDED);
    const uint pass = slot / params.window_pixels;
    const uint pixel = params.first_pixel + slot % params.window_pixels;
    PLANE(ids, ID_CELL)[slot] = slot;
    PLANE(ids, ID_PIXEL)[slot] = pixel;
    PLANE(ids, ID_PASS)[slot] = pass;
    PLANE(ids, ID_SAMPLE)[slot] = 0xFFFFFFFFu;  // generate_rays takes the next one, 0
    PLANE(ids, ID_LEFT)[slot] = plan[pass].samples;
    PLANE(ids, ID_SEED)[slot] = hash_pair(params.seed, pixel);
    PLANE(ids, ID_INDEX)[slot] = reverse_bits_32(plan[pass].first_sample - 1);
    PLANE(ids, ID_NONFINITE)[slot] = 0;
    for (int k = SUM_R; k < RADIANCE_PLANES; ++k) PLANE(radiances, k)[slot] = 0.0f;
}
