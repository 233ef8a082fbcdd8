#pragma once

#include "shared/small_mesh.h"

#include <optional>
#include <vector>

namespace wavepath {

// The triangles with corners that have the same coordinates, bit for bit, listed once; none if they
// are too many. `positions`: 9 a triangle.
std::optional<SmallMesh> small_mesh(const std::vector<float>& positions);

}  // namespace wavepath
