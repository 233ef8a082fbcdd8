// Mesh primitives as triangle lists.
#pragma once

#include "scene/gltf_file.h"
#include "scene/gltf_ignored.h"
#include "scene/scene.h"

#include <vector>

namespace wavepath {

// The primitives of mesh `index` that hold triangles, in order; points and lines are noted in
// `ignored`. Of `materials`, read_materials(), the last is that of primitives that name none.
std::vector<Primitive> read_mesh(
    const GltfFile& file, int index, const std::vector<Material>& materials, Ignored& ignored);

}  // namespace wavepath
