// The two containers of glTF, .gltf and .glb, told apart by their first bytes, and the JSON in
// them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wavepath {

bool is_binary(std::span<const unsigned char> bytes);

// Throws Error for a binary file of another version, or whose lengths are wrong: tinygltf has one
// text for all of that. `name` is the file's, for messages.
void check_glb_header(std::span<const unsigned char> bytes, const std::string& name);

// Of a binary file: one that check_glb_header has passed.
std::string_view json_text(std::span<const unsigned char> bytes);
bool starts_like_json(std::span<const unsigned char> bytes);

// tinygltf turns nesting in `extras` into recursion: 100 kB of brackets would overflow the stack.
bool is_nested_deeper_than(std::string_view json, int limit);

// The file with other JSON.
std::vector<unsigned char> with_json(std::span<const unsigned char> bytes, std::string_view json);

}  // namespace wavepath
