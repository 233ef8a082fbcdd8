// Adds every finished sample to its unit's sum, and hands the sum over when the unit is done.
// reads: ended queue, plan    writes: radiances, ids, cells, cell_flags
// One work-item an ended path. A cell belongs to one unit, so it has one writer.

#include "sampling/vector.cl"
#include "shared/inline.h"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

// Tested on the bits: a compiler may assume that isfinite() holds.
INLINE int is_finite_bits(const float x) {
    return (as_uint(x) & 0x7f800000u) != 0x7f800000u;
}

kernel void accumulate(
    constant const RenderParams* restrict params,
    global const QueueSizes* restrict sizes,
    global const uint* restrict ended,
    global const PlanRow* restrict plan,
    global float* restrict radiances,
    global uint* restrict ids,
    global float* restrict cells,
    global uint* restrict cell_flags) {
    const uint i = (uint)get_global_id(0);
    if (i >= sizes->ended) return;
    const int slot = (int)ended[i];
    const int stride = (int)params->stride;
    const Vec3 radiance = load3(PLANE(radiances, RADIANCE_R), stride, slot);
    const uint sample = PLANE(ids, ID_SAMPLE)[slot];
    const int finite = is_finite_bits(radiance.x) && is_finite_bits(radiance.y) && is_finite_bits(radiance.z);
    const uint flags = PLANE(ids, ID_NONFINITE)[slot];
    const uint counted = (flags + 0x10000u) | (flags == 0 ? sample + 1 : 0);
    const uint new_flags = finite ? flags : counted;
    const int done = sample + 1 >= plan[(int)PLANE(ids, ID_PASS)[slot]].samples;
    const int cell = (int)PLANE(ids, ID_CELL)[slot];
    const int cells_stride = (int)params->cells;

    const Vec3 sum = add3(load3(PLANE(radiances, SUM_R), stride, slot), radiance);
    PLANE(ids, ID_NONFINITE)[slot] = done ? 0 : new_flags;
    store3(PLANE(radiances, SUM_R), stride, slot, select3(done, vec3(0.0f, 0.0f, 0.0f), sum));
    if (done) {
        store3(cells, cells_stride, cell, sum);
        cell_flags[cell] = new_flags;
    }
#pragma unroll
    for (int k = 3; k < SUM_PLANES; ++k) {
        global float* plane = PLANE(radiances, SUM_R + k);
        const float value = plane[slot];
        plane[slot] = done ? 0.0f : value;
        if (done) cells[k * cells_stride + cell] = value;
    }
}
