// Reads accessors of a glTF file whatever their encoding: interleaved, normalized, sparse, without
// a buffer view.
#pragma once

#include "scene/gltf_file.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace wavepath {

// Three numbers a row of a VEC3 (of a VEC4: its first three), finite; normalized integers as
// fractions. `where` names what the accessor is for: mesh 3 "lamp", POSITION.
std::vector<float> read_vec3(const GltfFile& file, int accessor, std::string_view where);

// Indices, each below `vertex_count` and none the primitive restart value, which glTF forbids.
std::vector<std::uint32_t> read_indices(
    const GltfFile& file, int accessor, std::size_t vertex_count, std::string_view where);

}  // namespace wavepath
