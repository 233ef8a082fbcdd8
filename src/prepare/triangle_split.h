// Bounds of triangles and of parts of them, as the BVH builder needs them.
#pragma once

#include "prepare/embree.h"

#include <cstddef>
#include <vector>

namespace wavepath {

// Of triangle `triangle` of `positions`, 9 floats each.
RTCBounds triangle_bounds(const std::vector<float>& positions, std::size_t triangle);

// False for a triangle whose corners lie on one line, exactly: no ray hits it.
bool has_area(const std::vector<float>& positions, std::size_t triangle);

// Bounds of what lies on either side of an axis-aligned plane, within the primitive's own bounds,
// for spatial splits [Stich 2009, section 4]: an RTCSplitPrimitiveFunction whose `positions` is a
// std::vector<float>.
void split_triangle(
    const RTCBuildPrimitive* primitive,
    unsigned dimension,
    float plane,
    RTCBounds* left,
    RTCBounds* right,
    void* positions);

}  // namespace wavepath
