#pragma once

#include "shared/bvh.h"

#include <vector>

namespace wavepath {

struct Bvh {
    std::vector<BvhNode> nodes;         // root first; at least one
    std::vector<TriangleBlock> blocks;  // a triangle may stand in several (spatial splits)
    double build_seconds = 0;
};

// Builds with Embree's rtcBuildBVH: branching 8, surface-area heuristic, spatial splits where they
// pay, in parallel. `positions`: 9 floats a triangle (three corners), finite, in normalised space;
// triangles of zero area are left out.
Bvh build_bvh(const std::vector<float>& positions);

// Marks the triangles that let some rays pass (BVH_HOLES); one flag a triangle.
void mark_holes(Bvh& bvh, const std::vector<bool>& holes);

}  // namespace wavepath
