// Adds every finished sample to its unit's sum, and hands the sum over when the unit is done.
//
// reads: hits, throughputs, radiances, ids
//
// writes: radiances, ids, cells, cell_flags
//
// One work-item a slot. A cell belongs to one unit, so it has one writer.

#include "geometry/path_state.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"

// Tested on the bits: a compiler may assume that isfinite() holds.
INLINE int is_finite_bits(const float x) {
    return (as_uint(x) & 0x7f800000u) != 0x7f800000u;
}

kernel void accumulate(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict hits,
    global const float* restrict throughputs,
    global float* restrict radiances,
    global uint* restrict ids,
    global float* restrict cells,
    global uint* restrict cell_flags) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    if (hit_of(hits, stride, slot) != HIT_ENDED) return;
    // A throughput that is no number spoils the sample, whether or not it met a light.
    const Vec3 radiance = madd3(
        load3(PLANE(radiances, RADIANCE_R), stride, slot),
        load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), 0.0f);
    const uint sample = PLANE(ids, ID_SAMPLE)[slot];
    const int first = sample == 0;
    const Vec3 before = load3(PLANE(radiances, SUM_R), stride, slot);
    store3(PLANE(radiances, SUM_R), stride, slot, select3(first, radiance, add3(before, radiance)));

    const int finite =
        is_finite_bits(radiance.x) & is_finite_bits(radiance.y) & is_finite_bits(radiance.z);
    const uint flags = first ? 0 : PLANE(ids, ID_NONFINITE)[slot];
    const uint counted = (flags + 0x10000u) | (flags == 0 ? sample + 1 : 0);
    PLANE(ids, ID_NONFINITE)[slot] = finite ? flags : counted;

    if (PLANE(ids, ID_LEFT)[slot] > 0) return;
    const size_t cell = PLANE(ids, ID_CELL)[slot];
    cell_flags[cell] = finite ? flags : counted;
#pragma unroll
    for (int k = 0; k < SUM_PLANES; ++k)
        cells[cell * CELL_FLOATS + k] = PLANE(radiances, SUM_R + k)[slot];
}
