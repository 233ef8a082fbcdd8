// Tangents of the corners of a primitive's triangles.
#pragma once

#include "scene/scene.h"

namespace wavepath {

// As MikkTSpace defines them [Mikkelsen 2008]: along u, orthogonal to the corner's normal, the mean
// of the triangles that share the vertex (position, normal and coordinates alike) and the
// handedness of their coordinates, weighed by their angles there. Its walk from edge to edge is
// left out: triangles that meet at a vertex only count as neighbours too. `uvs`: 2 a vertex. 4
// floats a corner.
std::vector<float> derive_tangents(const Primitive& primitive, const std::vector<float>& uvs);

// Those of the file, 4 a vertex, for each corner; unit, sign 1 or -1.
std::vector<float> expand_tangents(
    const Primitive& primitive, const std::vector<float>& vertex_tangents);

}  // namespace wavepath
