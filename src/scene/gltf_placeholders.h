#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace wavepath {

// tinygltf refuses two things that compressed files may leave out: the data of a buffer that only
// stands in where EXT_meshopt_compression is unknown, and the bufferView of indices that
// KHR_draco_mesh_compression holds. Returns JSON with a byte for the one and without the other;
// none where the file uses neither extension or cannot be parsed. In a `binary` file the first
// buffer without a URI is the second chunk.
std::optional<std::string> with_placeholders(std::string_view json, bool binary);

}  // namespace wavepath
