// How the host looks through a BVH.
#pragma once

#include "prepare/bvh_builder.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavepath {

// Visits the triangles of the leaves below all children that `enters(node, child)` lets in, until
// `visit(triangle)` returns true. Returns whether it did.
template <typename Enters, typename Visit>
bool walk(const Bvh& bvh, const Enters& enters, const Visit& visit) {
    std::vector<uint32_t> waiting{0};
    while (!waiting.empty()) {
        const uint32_t current = waiting.back();
        waiting.pop_back();
        if ((current & BVH_LEAF) != 0) {
            for (const uint32_t entry : bvh.blocks[current & ~BVH_LEAF].primitives)
                if (entry != BVH_EMPTY && visit(entry & ~BVH_HOLES)) return true;
            continue;
        }
        const BvhNode& node = bvh.nodes[current];
        for (std::size_t child = 0; child < 8; ++child)
            if (node.children[child] != BVH_EMPTY && enters(node, child))
                waiting.push_back(node.children[child]);
    }
    return false;
}

}  // namespace wavepath
