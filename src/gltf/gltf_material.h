// Materials of a glTF file.
#pragma once

#include "gltf/gltf_file.h"
#include "gltf/gltf_ignored.h"
#include "scene/scene.h"

#include <vector>

namespace wavepath {

// The file's materials in order, then the default one: white, metallic 1, roughness 1 [glTF 2.0,
// section 3.9.6]. Their textures name images of the file, which load_images (gltf_texture.h) makes
// those of the scene. Factors outside the range glTF gives them are an error: a base color above 1
// would make energy.
std::vector<Material> read_materials(const GltfFile& file, Ignored& ignored);

}  // namespace wavepath
