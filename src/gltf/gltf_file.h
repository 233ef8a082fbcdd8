// A parsed glTF file and the words for its elements. tinygltf checks no index: references are
// followed through at() only.
#pragma once

#include "error.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wavepath {

struct GltfFile {
    std::string name;  // without folders, for messages
    tinygltf::Model model;
    std::vector<std::filesystem::path> files;  // its buffers and images beside it
    std::vector<std::string> missing_data;     // why a buffer of the file has no data, or ""

    // `message` says what is wrong, then, after a semicolon, what to do.
    template <typename... Args>
    [[noreturn]] void fail(
        std::string_view where, fmt::format_string<Args...> message, Args&&... args) const {
        throw Error("{}: {}: {}", name, where, fmt::format(message, std::forward<Args>(args)...));
    }

    // The element a reference of `where` points to.
    template <typename T>
    const T& at(
        const std::vector<T>& elements,
        int index,
        std::string_view kind,
        std::string_view where) const {
        if (index < 0 || static_cast<std::size_t>(index) >= elements.size())
            fail(
                where,
                "refers to {} {}, but the file has {} of them; repair the index or export again",
                kind, index, elements.size());
        return elements[static_cast<std::size_t>(index)];
    }
};

// Parses a .gltf or .glb file with its buffers, told apart by content. Images stay encoded, in
// tinygltf::Image::image or their buffer view, and may be missing, as may buffers. Throws Error for
// what is no glTF 2.0, and for a required extension that is not supported, which is named first.
GltfFile read_gltf_file(const std::filesystem::path& path);

bool is_supported_extension(std::string_view name);

// `mesh 3 "lamp"`, or `mesh 3` where it has no name.
std::string label(std::string_view kind, int index, const std::string& name);

// `text` on one line of bounded length: names and parser messages come from the file.
std::string one_line(std::string text);

// The extension's object, or null where the element does not carry it.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name);

// Member `key` of an extension's object: `missing` where absent; fails where it is no number.
double number(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::Value& object,
    const char* key,
    double missing);

// The same for an integer from 0 to 2^31 - 1: an index, an offset or a size. Fails where it is
// absent and nothing stands in for it.
int integer(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::Value& object,
    const char* key,
    std::optional<int> missing = std::nullopt);

// The same for an array of numbers.
std::vector<double> numbers(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::Value& object,
    const char* key,
    const std::vector<double>& missing);

}  // namespace wavepath
