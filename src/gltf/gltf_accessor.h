// Reads accessors of a glTF file whatever their encoding: interleaved, normalized, sparse, without
// a buffer view.
#pragma once

#include "gltf/gltf_file.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wavepath {

// `length` bytes of a buffer from `offset` on; `where` names who asks for them.
std::span<const unsigned char> buffer_bytes(
    const GltfFile& file,
    int buffer,
    std::size_t offset,
    std::size_t length,
    std::string_view where);

// The bytes of a buffer view.
std::span<const unsigned char> view_bytes(const GltfFile& file, int view, std::string_view where);

// `width` numbers a row, finite; normalized integers as fractions. A vector may have more
// components than `width` (1 .. 4), of which the first are read; 16 reads a MAT4, column by column.
// `where` names what the accessor is for: mesh 3 "lamp", POSITION.
std::vector<float> read_vectors(
    const GltfFile& file, int accessor, std::size_t width, std::string_view where);

// The attribute `name` of a primitive, `width` numbers a row; none where it has none. Fails where
// it has not `vertex_count` rows, if that is given.
std::optional<std::vector<float>> read_attribute(
    const GltfFile& file,
    const tinygltf::Primitive& source,
    const std::string& name,
    std::size_t width,
    std::optional<std::size_t> vertex_count,
    std::string_view where);

// Indices, each below `vertex_count` and none the primitive restart value, which glTF forbids.
std::vector<std::uint32_t> read_indices(
    const GltfFile& file, int accessor, std::size_t vertex_count, std::string_view where);

}  // namespace wavepath
