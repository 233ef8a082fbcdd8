// KHR_draco_mesh_compression: primitives whose triangles are compressed by Draco.
#pragma once

#include "gltf/gltf_file.h"

namespace wavepath {

// Gives every compressed primitive accessors of its own with its data, and indices: it is then read
// like any other. Throws Error for data that do not decode.
void decode_draco(GltfFile& file);

}  // namespace wavepath
