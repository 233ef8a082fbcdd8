// Starts a window: gives every slot its first unit of work, one before its first sample.
// reads: params    writes: ids, sums, both queues, sizes
// One work-item a slot in use.

#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void assign_units(
    constant const RenderParams* restrict params,
    global uint* restrict active,
    global uint* restrict ended,
    global QueueSizes* restrict sizes,
    global uint* restrict ids,
    global float* restrict radiances) {
    const uint i = (uint)get_global_id(0);
    if (i >= params->pool) return;
    active[i] = i;
    ended[i] = i;
    if (i == 0) {
        sizes->active = params->pool;
        sizes->ended = params->pool;
        sizes->runaway_lock = 0;
    }
    PLANE(ids, ID_CELL)[i] = i;
    PLANE(ids, ID_PIXEL)[i] = params->first_pixel + i % params->window_pixels;
    PLANE(ids, ID_PASS)[i] = i / params->window_pixels;
    PLANE(ids, ID_SAMPLE)[i] = 0xFFFFFFFFu;  // generate_rays takes the next one, 0
    PLANE(ids, ID_NONFINITE)[i] = 0;
    for (int k = SUM_R; k < RADIANCE_PLANES; ++k) PLANE(radiances, k)[i] = 0.0f;
}
