// What a glTF material encloses: KHR_materials_volume and this project's extras.wavepath_medium
// (docs/media.md).
#pragma once

#include "gltf/gltf_file.h"
#include "gltf/gltf_ignored.h"
#include "scene/scene.h"

namespace wavepath {

// Fills `material.boundary` and `material.medium`, whose factors and ior have been read. A material
// that transmits in a way this program does not do stays opaque, and `ignored` says so. Fails for
// coefficients that mean nothing.
void read_medium(const GltfFile& file, int index, Material& material, Ignored& ignored);

// Notes wavepath_medium in the extras of what encloses nothing: nodes, meshes and their primitives;
// and in the extensions of materials or their extras.
void note_misplaced_media(const tinygltf::Model& model, Ignored& ignored);

}  // namespace wavepath
