// The acceleration structure: an 8-wide BVH over blocks of 8 triangles, in structure-of-arrays form
// so that one ray tests 8 boxes or 8 triangles with one float8 operation each [Wald 2008].
#ifndef WAVEPATH_BVH_H
#define WAVEPATH_BVH_H

#include "shared/cl_types.h"

// children[k]: an inner node's index, or BVH_LEAF | the index of a block, or BVH_EMPTY.
#define BVH_LEAF 0x80000000u
#define BVH_EMPTY 0xFFFFFFFFu
#define BVH_HOLES 0x80000000u  // of a triangle that lets some rays pass (HAS_ALPHA)
#define BVH_STACK 96           // entries; the builder refuses a tree that could need more

typedef struct {
    // [axis][0: low, 1: high][child], normalised scene space; an empty child's box is inverted
    shared_float bounds[3][2][8];
    shared_uint children[8];
} BvhNode;
SHARED_SIZE(BvhNode, 224);

typedef struct {
    shared_float vertices[3][3][8];  // [vertex][axis][lane]; unused lanes are degenerate triangles
    shared_uint primitives[8];  // triangle ids in scene order, | BVH_HOLES; BVH_EMPTY in unused
                                // lanes
} TriangleBlock;
SHARED_SIZE(TriangleBlock, 320);

#endif
