// Many rays traced by one work-item in turn, one step each, so that one ray's next node is fetched
// while the others compute: for CPUs, where a lone ray waits for memory most of the time
// (docs/design/intersect.md has the measurements; on a GPU other work-items hide the wait).
//
//     RayStream stream;
//     stream_open(&stream);
//     do {
//         while (rays are left && stream_has_room(&stream)) stream_add(&stream, item, ...);
//         stream_step(&stream, tree, &cover, any);
//         for (int k = 0; k < stream.ended; ++k) use stream_ended(&stream, k)
//     } while (rays are left || stream_busy(&stream));
//
// The rays at a node and those at a leaf step in two separate loops whose bodies hold hardly a
// branch: with sixteen rays in turn a branch predictor has nothing to learn from.
#pragma once

#include "geometry/bvh.cl"
#include "sampling/vector.cl"

#ifndef RAYS_PER_ITEM
#define RAYS_PER_ITEM 1  // rays that a work-item traces; 1: each on its own
#endif
#define STREAM_RAYS 16  // of them at a time

// Eight entries below the first and above the last: the stack is read and written in eights.
#define STREAM_STACK (8 + BVH_STACK + 8)

typedef struct {
    SlabRay slabs;
    ShearedRay sheared;
    RayStart start;
    Hit hit;       // the closest so far; any hit: `primitive` >= 0 if there is one
    uint key;      // Cover's (HAS_ALPHA)
    uint item;     // the caller's name for the ray
    uint current;  // node or leaf of the next step, BVH_EMPTY: ended
    int top;       // just above the waiting entries
    uint waiting[STREAM_STACK];
    float waiting_t[STREAM_STACK];
} StreamRay;

typedef struct {
    StreamRay rays[STREAM_RAYS];
    int at_node[STREAM_RAYS + 1];  // indices of `rays`; each ray is in one of the three lists
    int at_leaf[STREAM_RAYS + 1];
    int idle[STREAM_RAYS + 1];
    int nodes, leaves, idles;
    int ended;  // the last of the idle ones, which ended in the last step
} RayStream;

INLINE void stream_open(RayStream* stream) {
    stream->nodes = 0;
    stream->leaves = 0;
    stream->idles = STREAM_RAYS;
    stream->ended = 0;
    for (int i = 0; i < STREAM_RAYS; ++i) stream->idle[i] = i;
}

INLINE int stream_has_room(const RayStream* stream) {
    return stream->idles > 0;
}

INLINE int stream_busy(const RayStream* stream) {
    return stream->idles < STREAM_RAYS;
}

INLINE const StreamRay* stream_ended(const RayStream* stream, const int k) {
    return &stream->rays[stream->idle[stream->idles - 1 - k]];
}

INLINE void stream_add(
    RayStream* stream, const uint item, const Ray* added, const RayStart start, const uint key) {
    --stream->idles;
    const int i = stream->idle[stream->idles];
    StreamRay* ray = &stream->rays[i];
    ray->slabs = slab_ray(added);
    ray->sheared = shear_ray(added);
    if (STARTS_BEHIND) ray->start = start;
    ray->hit.t = end_of_ray(added);
    ray->hit.u = 0.0f;
    ray->hit.v = 0.0f;
    ray->hit.primitive = -1;
    ray->item = item;
    if (HAS_ALPHA) ray->key = key;
    ray->current = 0;
    ray->top = 8;
    vstore8((float8)(-1.0f), 0, ray->waiting_t);
    ray->waiting[7] = BVH_EMPTY;  // the end mark, no farther than any hit
    stream->at_node[stream->nodes] = i;
    ++stream->nodes;
}

// Fetches what the ray's next step reads; says whether that is a leaf, or the end.
INLINE int fetch_next(const StreamRay* ray, const Tree tree) {
    const uint next = ray->current;
    const int leaf = (int)(next >> 31);
    const size_t index = next & ~BVH_LEAF;
    const size_t start = leaf ? (size_t)tree.blocks + index * sizeof(TriangleBlock)
                              : (size_t)tree.nodes + index * sizeof(BvhNode);
    PREFETCH_LINE(start, 0);
    PREFETCH_LINE(start, 64);
    PREFETCH_LINE(start, 128);
    PREFETCH_LINE(start, 192);
    PREFETCH_LINE(start, 192 + 64 * leaf);
    return leaf;
}

// The topmost of the waiting entries that is nearer than the hit; if none of the top eight is, the
// one below them, which costs a step in vain.
INLINE int next_waiting(const StreamRay* ray) {
    const int low = ray->top - 8;
    return low + 31 - (int)clz(lane_mask(vload8(0, ray->waiting_t + low) <= ray->hit.t));
}

// Enters the nearest child, of any hit the last one; the others wait in their order in the node.
INLINE void step_node(StreamRay* ray, global const BvhNode* node, const int any) {
    float8 t_near;
    const int8 crossed =
        intersect_node(node, &ray->slabs, STARTS_BEHIND ? ray->start.t : 0.0f, ray->hit.t, &t_near);
    const uint lanes = lane_mask(crossed);
    uint lane = 31u - clz(lanes | 1u);
    if (!any) {
        // Distances are not negative, so their bits compare like integers; the lane takes the
        // low 3.
        const int8 keys = (as_int8(t_near) & ~7) | (int8)(0, 1, 2, 3, 4, 5, 6, 7);
        lane = (uint)least_lane(select((int8)(0x7FFFFFFF), keys, crossed)) & 7u;
    }
    const uint others = lanes & ~(1u << lane);
    const int top = ray->top;
    const int entered = top + (int)popcount(others);
    if (!any) vstore8(as_float8(pack_lanes(as_int8(t_near), others)), 0, ray->waiting_t + top);
    const int8 children = as_int8(vload8(0, node->children));
    vstore8(as_uint8(pack_lanes(children, others)), 0, ray->waiting + top);
    ray->waiting[entered] = node->children[lane];
    // One load for both cases: a choice between two loads would become a branch.
    const int popped = any ? top - 1 : next_waiting(ray);
    ray->top = lanes != 0 ? entered : popped;
    ray->current = ray->waiting[ray->top];
}

INLINE void step_leaf(
    StreamRay* ray, global const TriangleBlock* block, const Cover* scene, const int any) {
    Cover cover = *scene;
    if (HAS_ALPHA) cover.key = ray->key;
    if (any) {
        ray->hit.primitive = any_in_block(block, &ray->sheared, &cover, ray->hit.t) ? 0 : -1;
        ray->top = ray->hit.primitive < 0 ? ray->top - 1 : 7;
    } else {
        closest_in_block(block, &ray->sheared, ray->start, &cover, &ray->hit);
        ray->top = next_waiting(ray);
    }
    ray->current = ray->waiting[ray->top];
}

// One step of every ray. `scene`: the cover of all rays but for the key, which each has of its own.
// `any`: the first hit ends a ray (a constant: the compiler drops the rest).
INLINE void stream_step(RayStream* stream, const Tree tree, const Cover* scene, const int any) {
    int at_node = 0;
    int at_leaf = stream->leaves;
    for (int k = 0; k < stream->nodes; ++k) {
        const int i = stream->at_node[k];
        StreamRay* ray = &stream->rays[i];
        step_node(ray, tree.nodes + ray->current, any);
        const int leaf = fetch_next(ray, tree);
        stream->at_node[at_node] = i;
        stream->at_leaf[at_leaf] = i;
        at_node += 1 - leaf;
        at_leaf += leaf;
    }
    const int leaves = at_leaf;
    at_leaf = 0;
    stream->ended = 0;
    for (int k = 0; k < leaves; ++k) {
        const int i = stream->at_leaf[k];
        StreamRay* ray = &stream->rays[i];
        if (ray->current == BVH_EMPTY) {
            stream->idle[stream->idles] = i;
            ++stream->idles;
            ++stream->ended;
            continue;
        }
        step_leaf(ray, tree.blocks + (ray->current & ~BVH_LEAF), scene, any);
        const int leaf = fetch_next(ray, tree);
        stream->at_node[at_node] = i;
        stream->at_leaf[at_leaf] = i;
        at_node += 1 - leaf;
        at_leaf += leaf;
    }
    stream->nodes = at_node;
    stream->leaves = at_leaf;
}
