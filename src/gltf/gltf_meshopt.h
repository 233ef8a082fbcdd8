// EXT_meshopt_compression: buffer views whose data are compressed by meshoptimizer.
#pragma once

#include "gltf/gltf_file.h"

namespace wavepath {

// Gives every compressed buffer view a buffer of its own with its data: accessors then read them
// like any other. All modes and filters. Throws Error for data that do not decode, and for
// properties that the extension does not allow.
void decode_meshopt(GltfFile& file);

}  // namespace wavepath
