// The bytes that a glTF file refers to: its buffers and images, in data URIs, in files beside it or
// in its binary chunk. tinygltf sees none of them: it refuses files for bytes that nothing reads.
#pragma once

#include "gltf/gltf_file.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <span>

namespace wavepath {

// Takes `buffers` and `images` out of `root`, whose types are right, and puts them into
// `file.model` with their bytes; images stay encoded, or in their buffer view. What has no bytes is
// empty, and `file.missing_data` says why of buffers. `folder` is the file's, `chunk` its BIN.
void take_data(
    nlohmann::json& root,
    const std::filesystem::path& folder,
    std::optional<std::span<const unsigned char>> chunk,
    GltfFile& file);

}  // namespace wavepath
