// Moves paths into idle slots, plane by plane.
//
// reads: holes, movers, rays, hits, throughputs, radiances, ids, path_media, branches
//
// writes: rays, hits, throughputs, radiances, ids, path_media, branches
//
// One work-item a path; no slot is read and written in one launch.

#include "sampling/branch.cl"
#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/params.h"
#include "shared/path.h"

kernel void move_paths(
    constant const RenderParams* restrict settings,
    global const uint* restrict holes,
    global const uint* restrict movers,
    global float* restrict rays,
    global float* restrict hits,
    global float* restrict throughputs,
    global float* restrict radiances,
    global uint* restrict ids,
    global float* restrict path_media,
    global float* restrict branches) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const uint i = (uint)get_global_id(0);
    if (i >= movers[0]) return;
    const uint from = movers[i + 1];
    const uint to = holes[i];
    for (int k = 0; k < RAY_PLANES; ++k) PLANE(rays, k)[to] = PLANE(rays, k)[from];
    for (int k = 0; k < HIT_PLANES; ++k) PLANE(hits, k)[to] = PLANE(hits, k)[from];
    for (int k = 0; k < THROUGHPUT_PLANES; ++k)
        PLANE(throughputs, k)[to] = PLANE(throughputs, k)[from];
    for (int k = 0; k < RADIANCE_PLANES; ++k) PLANE(radiances, k)[to] = PLANE(radiances, k)[from];
    const int id_planes = HAS_SPLITS ? ID_PLANES : ID_PLANES_UNSPLIT;
    for (int k = 0; k < id_planes; ++k) PLANE(ids, k)[to] = PLANE(ids, k)[from];
    const int medium_planes = HAS_PASSAGES ? MEDIUM_PLANES_USED : 0;
    for (int k = 0; k < medium_planes; ++k) PLANE(path_media, k)[to] = PLANE(path_media, k)[from];
    const int branch_planes =
        HAS_SPLITS ? (int)(BRANCH_PLANES_USED * BRANCH_LEVELS * params.split_depth) : 0;
    for (int k = 0; k < branch_planes; ++k) PLANE(branches, k)[to] = PLANE(branches, k)[from];
    set_hit(hits, stride, from, HIT_IDLE);
}
