// Takes paths that ended back to their last branch vertex with children to run (notes 2, N > 1:
// S directions from a point; notes 6: N stops on a segment, M directions from each). Children run
// one after the other in their parent's slot, so a slot stays one path.
//
// reads: branches, hits, throughputs, ids, fates
//
// writes: branches, hits, rays, throughputs, ids, path_media, fates
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "sampling/branch.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void resume_branch(
    constant const RenderParams* restrict settings,
    const uint slots,
    global float* restrict branches,
    global float* restrict hits,
    global float* restrict rays,
    global float* restrict throughputs,
    global uint* restrict ids,
    global float* restrict path_media,
    global uchar* restrict fates) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    if (hit_of(hits, stride, slot) != HIT_ENDED) return;
    uint level = PLANE(ids, ID_STACK)[slot];
    while (level > 0 &&
           as_uint(PLANE(branch_at(branches, stride, level - 1), BRANCH_LEFT)[slot]) == 0)
        --level;
    PLANE(ids, ID_STACK)[slot] = level;
    if (level == 0) return;
    global const float* branch = branch_at(branches, stride, level - 1);
    PLANE(hits, HIT_PRIMITIVE)[slot] = PLANE(branch, BRANCH_PRIMITIVE)[slot];
    PLANE(hits, HIT_T)[slot] = HAS_MEDIA ? PLANE(branch, BRANCH_T)[slot] : T_RESUMED;
    PLANE(hits, HIT_U)[slot] = PLANE(branch, BRANCH_U)[slot];
    PLANE(hits, HIT_V)[slot] = PLANE(branch, BRANCH_V)[slot];
    store3(
        PLANE(rays, RAY_DIRECTION_X), stride, slot,
        load3(PLANE(branch, BRANCH_DIRECTION_X), stride, slot));
    // a child whose throughput was no number spoils the sample (accumulate)
    const Vec3 before = load3(PLANE(throughputs, THROUGHPUT_R), stride, slot);
    store3(
        PLANE(throughputs, THROUGHPUT_R), stride, slot,
        madd3(load3(PLANE(branch, BRANCH_R), stride, slot), before, 0.0f));
    PLANE(ids, ID_SCATTERING)
    [slot] = HAS_MEDIA ? as_uint(PLANE(branch, BRANCH_SCATTERING)[slot]) : level - 1;
    PLANE(ids, ID_BRANCH)[slot] = as_uint(PLANE(branch, BRANCH_ID)[slot]);
    PLANE(ids, ID_SHARES)[slot] = as_uint(PLANE(branch, BRANCH_SHARES)[slot]);
    if (HAS_MEDIA) {
        store3(
            PLANE(rays, RAY_ORIGIN_X), stride, slot,
            load3(PLANE(branch, BRANCH_ORIGIN_X), stride, slot));
        PLANE(throughputs, THROUGHPUT_PDF)[slot] = PLANE(branch, BRANCH_PDF)[slot];
#pragma unroll
        for (int k = 0; k < MEDIUM_PLANES_USED; ++k)
            PLANE(path_media, k)[slot] = PLANE(branch, BRANCH_MEDIA + k)[slot];
    }
    fates[slot] = (uchar)((fates[slot] & ~FATE_ENDED) | FATE_ACTIVE | FATE_RESUMED);
}
