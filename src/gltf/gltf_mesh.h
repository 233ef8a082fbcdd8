// Mesh primitives as triangle lists.
#pragma once

#include "gltf/gltf_file.h"
#include "gltf/gltf_ignored.h"
#include "scene/scene.h"

#include <vector>

namespace wavepath {

// The shape a node gives its mesh.
struct Pose {
    std::vector<double> weights;  // one a morph target, or none: the base shape
    std::vector<Matrix4> joints;  // from the mesh to where it is placed, or none: no skin

    // NOLINTNEXTLINE(modernize-use-nullptr): compares with the literal 0, which is no pointer here
    auto operator<=>(const Pose&) const = default;
};

// The primitives of mesh `index` that hold triangles, in order; points and lines are noted in
// `ignored`. Of `materials`, read_materials(), the last is that of primitives that name none.
std::vector<Primitive> read_mesh(
    const GltfFile& file,
    int index,
    const Pose& pose,
    const std::vector<Material>& materials,
    Ignored& ignored);

}  // namespace wavepath
