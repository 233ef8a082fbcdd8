#include "gltf/gltf_container.h"

#include "error.h"

#include <cstdint>
#include <cstring>

namespace wavepath {
namespace {

constexpr std::size_t glb_header_size = 12;  // magic, version, length

std::uint32_t word_at(std::span<const unsigned char> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

std::string_view as_text(std::span<const unsigned char> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The chunks of a binary file without its header: length, type, data.
GltfContainer open_chunks(std::span<const unsigned char> chunks, const std::string& name) {
    GltfContainer container;
    for (bool is_first = true; chunks.size() >= 8; is_first = false) {
        const std::size_t size = word_at(chunks, 0);
        const std::string_view type = as_text(chunks.subspan(4, 4));
        chunks = chunks.subspan(8);
        if (size > chunks.size())
            throw Error("{}: is cut short or gives a wrong length; copy or export it again", name);
        if (size % 4 != 0)
            throw Error(
                "{}: a chunk of {} bytes is not padded to a multiple of 4; export again", name,
                size);
        if (is_first != (type == "JSON"))
            throw Error("{}: its first chunk has to hold JSON, and no other; export again", name);
        if (is_first) container.json = as_text(chunks.first(size));
        if (type == std::string_view("BIN\0", 4) && !container.chunk)
            container.chunk = chunks.first(size);
        chunks = chunks.subspan(size);
    }
    return container;
}

}  // namespace

GltfContainer open_container(std::span<const unsigned char> bytes, const std::string& name) {
    if (!as_text(bytes).starts_with("glTF")) return {as_text(bytes), std::nullopt};
    if (bytes.size() >= 8 && word_at(bytes, 4) != 2)
        throw Error("{}: is binary glTF version {}; export as glTF 2.0", name, word_at(bytes, 4));
    constexpr std::size_t smallest = glb_header_size + 8;
    if (bytes.size() < smallest || word_at(bytes, 8) < smallest || bytes.size() < word_at(bytes, 8))
        throw Error("{}: is cut short or gives a wrong length; copy or export it again", name);
    return open_chunks(bytes.subspan(glb_header_size, word_at(bytes, 8) - glb_header_size), name);
}

bool starts_like_json(std::string_view text) {
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

}  // namespace wavepath
