#include "scene/gltf_container.h"

#include "error.h"

#include <cstdint>
#include <cstring>

namespace wavepath {
namespace {

// Magic, version, length; length and type of the JSON chunk.
constexpr std::size_t glb_header_size = 20;

std::uint32_t word_at(std::span<const unsigned char> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

}  // namespace

bool is_binary(std::span<const unsigned char> bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

void check_glb_header(std::span<const unsigned char> bytes, const std::string& name) {
    if (bytes.size() >= 8 && word_at(bytes, 4) != 2)
        throw Error("{}: is binary glTF version {}; export as glTF 2.0", name, word_at(bytes, 4));
    bool is_whole = bytes.size() >= glb_header_size && word_at(bytes, 8) >= glb_header_size &&
                    bytes.size() >= word_at(bytes, 8);
    // chunks: length, type, data
    for (std::size_t at = 12; is_whole && at + 8 <= word_at(bytes, 8);
         at += 8 + std::size_t{word_at(bytes, at)})
        is_whole = word_at(bytes, at) <= word_at(bytes, 8) - at - 8;
    if (!is_whole)
        throw Error("{}: is cut short or gives a wrong length; copy or export it again", name);
}

std::string_view json_text(std::span<const unsigned char> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return is_binary(bytes) ? text.substr(glb_header_size, word_at(bytes, 12)) : text;
}

bool starts_like_json(std::span<const unsigned char> bytes) {
    const std::string_view text = json_text(bytes);
    const std::size_t start =
        text.find_first_not_of("\xEF\xBB\xBF \t\r\n");  // after a byte order mark
    return start != text.npos && text[start] == '{';
}

bool is_nested_deeper_than(std::string_view json, int limit) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > limit) return true;
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return false;
}

std::vector<unsigned char> with_json(std::span<const unsigned char> bytes, std::string_view json) {
    if (!is_binary(bytes)) return {json.begin(), json.end()};
    const auto chunks = bytes.subspan(glb_header_size + word_at(bytes, 12));
    std::vector<unsigned char> file(bytes.begin(), bytes.begin() + glb_header_size);
    file.insert(file.end(), json.begin(), json.end());
    file.resize((file.size() + 3) / 4 * 4, ' ');  // header and chunks are multiples of 4
    const auto json_size = static_cast<std::uint32_t>(file.size() - glb_header_size);
    file.insert(file.end(), chunks.begin(), chunks.end());
    const auto size = static_cast<std::uint32_t>(file.size());
    std::memcpy(&file[8], &size, sizeof size);
    std::memcpy(&file[12], &json_size, sizeof json_size);
    return file;
}

}  // namespace wavepath
