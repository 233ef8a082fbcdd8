// The two containers of glTF, .gltf and .glb, told apart by their first bytes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace wavepath {

struct GltfContainer {
    std::string_view json;
    std::optional<std::span<const unsigned char>> chunk;  // BIN of a binary file that has one
};

// What a file of these bytes holds; it refers to them. Chunks of other types are passed over [glTF
// 2.0, section 4.4.3]. Throws Error for a binary file of another version, or whose lengths are
// wrong. `name` is the file's, for messages.
GltfContainer open_container(std::span<const unsigned char> bytes, const std::string& name);

bool starts_like_json(std::string_view text);

// 100 kB of brackets would overflow the stack of a parser that recurs.
bool is_nested_deeper_than(std::string_view json, int limit);

}  // namespace wavepath
