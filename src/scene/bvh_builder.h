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
// triangles of zero area may occur.
Bvh build_bvh(const std::vector<float>& positions);

}  // namespace wavepath
