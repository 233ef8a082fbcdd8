// Where paths branch (--splits): children run one after the other in their parent's slot, from a
// record of the vertex on the slot's stack (shared/path.h, BranchPlane).
#pragma once

#include "geometry/path_state.cl"
#include "sampling/rng.cl"
#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/params.h"
#include "shared/path.h"

#define MEDIUM_PLANES_USED (HAS_CONTACTS ? MEDIUM_PLANES : MEDIUM_PLANES_APART)
#define BRANCH_LEVELS (1u + HAS_MEDIA)  // of the stack, for each of --split-depth
#define BRANCH_PLANES_USED (HAS_MEDIA ? BRANCH_PLANES : BRANCH_PLANES_SURFACE)

INLINE global float* branch_at(global float* branches, const size_t stride, const uint level) {
    return PLANE(branches, level * BRANCH_PLANES_USED);
}

// The level of a path's next vertex. With media every second level is a segment's, which stays
// empty where the segment did not branch.
INLINE uint vertex_level(const uint stacked) {
    return HAS_MEDIA ? stacked | 1u : stacked;
}

// ID_BRANCH of a child: its own for every one, so that they draw numbers of their own.
INLINE uint branch_child(const uint parent, const uint children, const uint left) {
    return HAS_MEDIA ? hash_pair(parent, left) : parent * children + left;
}

// A path that may branch: its slot, and the planes that a record keeps some of.
typedef struct {
    size_t stride, slot;
    global const float* rays;
    global float* hits;
    global const float* throughputs;
    global const float* path_media;
    global uint* ids;
    global float* branches;
} BranchingPath;

// Opens the record `level` of a path with `stacked` records for `children` of what it is at: all
// but BRANCH_LEFT and what a child carries. `t` and `origin`: planes BRANCH_T and BRANCH_ORIGIN_X.
INLINE void open_branch(
    const BranchingPath* path,
    const uint level,
    const uint stacked,
    const float t,
    const uint children,
    const Vec3 origin) {
    const size_t stride = path->stride;
    const size_t slot = path->slot;
    global float* branches = path->branches;
    global uint* ids = path->ids;
    // the segment before a vertex did not branch
    if (level > stacked)
        PLANE(branch_at(branches, stride, stacked), BRANCH_LEFT)[slot] = as_float(0);
    global float* branch = branch_at(branches, stride, level);
    const float shares = as_float(PLANE(ids, ID_SHARES)[slot]) * (float)children;
    PLANE(ids, ID_STACK)[slot] = level + 1;
    PLANE(ids, ID_SHARES)[slot] = as_uint(shares);
    PLANE(branch, BRANCH_ID)[slot] = as_float(PLANE(ids, ID_BRANCH)[slot]);
    PLANE(branch, BRANCH_SHARES)[slot] = shares;
    PLANE(branch, BRANCH_PRIMITIVE)[slot] = PLANE(path->hits, HIT_PRIMITIVE)[slot];
    PLANE(branch, BRANCH_U)[slot] = PLANE(path->hits, HIT_U)[slot];
    PLANE(branch, BRANCH_V)[slot] = PLANE(path->hits, HIT_V)[slot];
    store3(
        PLANE(branch, BRANCH_DIRECTION_X), stride, slot,
        load3(PLANE(path->rays, RAY_DIRECTION_X), stride, slot));
    if (!HAS_MEDIA) return;
    PLANE(branch, BRANCH_SCATTERING)[slot] = as_float(PLANE(ids, ID_SCATTERING)[slot]);
    PLANE(branch, BRANCH_T)[slot] = t;
    store3(PLANE(branch, BRANCH_ORIGIN_X), stride, slot, origin);
    PLANE(branch, BRANCH_PDF)[slot] = PLANE(path->throughputs, THROUGHPUT_PDF)[slot];
#pragma unroll  // a loop keeps the whole stage scalar on PoCL
    for (int k = 0; k < MEDIUM_PLANES_USED; ++k)
        PLANE(branch, BRANCH_MEDIA + k)[slot] = PLANE(path->path_media, k)[slot];
}

typedef struct {
    Vec3 carried;  // throughput before its direction
    uint branch;   // ID_BRANCH
} Child;

// The next child of the vertex at `position` that the path is at, if it is one of the first
// `split_depth` and branches into `children`; else the path itself.
INLINE Child next_child(
    const BranchingPath* path, const uint split_depth, const uint children, const Vec3 position) {
    const size_t stride = path->stride;
    const size_t slot = path->slot;
    global float* hits = path->hits;
    global uint* ids = path->ids;
    Child child;
    child.carried = load3(PLANE(path->throughputs, THROUGHPUT_R), stride, slot);
    child.branch = 0;
    if (!HAS_SPLITS) return child;
    child.branch = PLANE(ids, ID_BRANCH)[slot];
    const uint stacked = PLANE(ids, ID_STACK)[slot];
    const int resumed = is_resumed(hits, stride, slot);
    const uint level = resumed ? stacked - 1 : vertex_level(stacked);
    PLANE(hits, HIT_T)[slot] = 0.0f;
    if (level >= BRANCH_LEVELS * split_depth) return child;
    global float* vertex = branch_at(path->branches, stride, level);
    uint left = as_uint(PLANE(vertex, BRANCH_LEFT)[slot]);
    if (!resumed) {
        left = children;
        child.carried = scale3(child.carried, 1.0f / (float)children);
        open_branch(path, level, stacked, T_RESUMED, children, position);
        store3(PLANE(vertex, BRANCH_R), stride, slot, child.carried);
    }
    PLANE(vertex, BRANCH_LEFT)[slot] = as_float(left - 1);
    child.branch = branch_child(as_uint(PLANE(vertex, BRANCH_ID)[slot]), children, left);
    PLANE(ids, ID_BRANCH)[slot] = child.branch;
    return child;
}
