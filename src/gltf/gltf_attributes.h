// What a primitive's vertices carry for its material's sake.
#pragma once

#include "gltf/gltf_file.h"
#include "gltf/gltf_ignored.h"
#include "scene/scene.h"

namespace wavepath {

// Fills uvs, tangents and alphas of `primitive`, whose positions, normals and indices are final and
// whose material is `material`: only what that uses. Coordinates that the mesh lacks are (0, 0),
// and `ignored` says so; tangents that it lacks are derived, and so are those of a mesh that is
// `bent` by morph targets or a skin, whose file gives them for its base shape.
void read_surface_attributes(
    const GltfFile& file,
    const tinygltf::Primitive& source,
    const Material& material,
    std::string_view where,
    bool bent,
    Primitive& primitive,
    Ignored& ignored);

}  // namespace wavepath
