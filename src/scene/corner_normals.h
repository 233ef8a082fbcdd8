// Vertex normals as the triangles of a primitive see them.
#pragma once

#include "scene/scene.h"

#include <array>

namespace wavepath {

// The vertex normals of triangle `triangle` of a primitive that has some, corner by corner, unit,
// in its space. glTF leaves open what a normal against the winding means, and exporters mirror
// meshes without turning either: the signs are turned where all three lie behind the face, or of
// one that does and is clearly against the others. The face's own normal, and with it the side that
// emits, is the winding's.
std::array<Vec3d, 3> corner_normals(const Primitive& primitive, std::size_t triangle);

}  // namespace wavepath
