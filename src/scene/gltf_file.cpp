#include "scene/gltf_file.h"

#include "scene/gltf_draco.h"
#include "scene/gltf_meshopt.h"
#include "scene/gltf_placeholders.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

namespace wavepath {
namespace {

namespace fs = std::filesystem;

// Sorted.
constexpr auto supported_extensions = std::to_array<std::string_view>({
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_scatter",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
});

// Magic, version, length; length and type of the JSON chunk.
constexpr std::size_t glb_header_size = 20;

std::vector<unsigned char> read_bytes(const fs::path& path) {
    std::error_code status;
    if (!fs::exists(path, status)) throw Error("{}: no such file; check the path", path.string());
    if (!fs::is_regular_file(path, status))
        throw Error("{}: is not a regular file; name a .gltf or .glb file", path.string());
    std::ifstream stream(path, std::ios::binary);
    std::vector<unsigned char> bytes(static_cast<std::size_t>(fs::file_size(path, status)));
    if (!stream.read(
            reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
        throw Error("{}: cannot be read; check its permissions", path.string());
    return bytes;
}

bool is_binary(std::span<const unsigned char> bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

std::uint32_t word_at(std::span<const unsigned char> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

// tinygltf has one text for all that can be wrong here.
void check_glb_header(std::span<const unsigned char> bytes, const std::string& name) {
    if (bytes.size() >= 8 && word_at(bytes, 4) != 2)
        throw Error("{}: is binary glTF version {}; export as glTF 2.0", name, word_at(bytes, 4));
    bool is_whole = bytes.size() >= glb_header_size && bytes.size() >= word_at(bytes, 8) &&
                    bytes.size() - glb_header_size >= word_at(bytes, 12);
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

// tinygltf turns nesting in `extras` into recursion: 100 kB of brackets would overflow the stack.
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

// tinygltf looks in the working directory too, as "./name": what is rendered must not depend on it.
bool is_file_beside_scene(const std::string& path, void*) {
    std::error_code status;
    return fs::path(path).is_absolute() && fs::is_regular_file(path, status);
}

// tinygltf would decode every image while it parses, and fail for one that it cannot decode.
bool leave_image_encoded(
    tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
    return true;
}

// glTF does not require these matrices [glTF 2.0, section 5.28], tinygltf does.
void forgive_skins(std::string& error) {
    constexpr std::string_view complaint = "'inverseBindMatrices' property is missing in Skin.\n";
    for (auto at = error.find(complaint); at != error.npos; at = error.find(complaint))
        error.erase(at, complaint.size());
}

// The file with other JSON.
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

// What tinygltf holds against the file, also where it claims success; empty: nothing.
std::string parse(
    std::span<const unsigned char> bytes, const fs::path& folder, tinygltf::Model& model) {
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(leave_image_encoded, nullptr);
    parser.SetFsCallbacks(
        {is_file_beside_scene, tinygltf::ExpandFilePath, tinygltf::ReadWholeFile,
         tinygltf::WriteWholeFile, nullptr});
    const auto size = static_cast<unsigned int>(bytes.size());
    std::string error, warning;
    try {
        const bool parsed =
            is_binary(bytes)
                ? parser.LoadBinaryFromMemory(
                      &model, &error, &warning, bytes.data(), size, folder.string())
                : parser.LoadASCIIFromString(
                      &model, &error, &warning, reinterpret_cast<const char*>(bytes.data()), size,
                      folder.string());
        forgive_skins(error);
        if (!parsed && error.empty()) error = "it cannot be parsed";
    } catch (const std::exception& exception) {
        error = fmt::format("it cannot be parsed ({})", exception.what());
    }
    return error;
}

using Version = std::pair<int, int>;  // major, minor

std::optional<Version> parse_version(const std::string& text) {
    Version version;
    const char* const end = text.data() + text.size();
    const auto [dot, major_error] = std::from_chars(text.data(), end, version.first);
    if (major_error != std::errc{} || dot == end || *dot != '.') return std::nullopt;
    const auto [rest, minor_error] = std::from_chars(dot + 1, end, version.second);
    if (minor_error != std::errc{} || rest != end) return std::nullopt;
    return version;
}

// A newer minor version stays readable unless minVersion says otherwise [glTF 2.0, section 3.2].
void check_version(const GltfFile& file) {
    const tinygltf::Asset& asset = file.model.asset;
    const auto version = parse_version(asset.version);
    if (!version || version->first != 2)
        file.fail(
            "asset", "version \"{}\" is not supported; export as glTF 2.0",
            one_line(asset.version));
    if (asset.minVersion.empty()) return;
    const auto needed = parse_version(asset.minVersion);
    if (!needed || *needed > Version{2, 0})
        file.fail(
            "asset", "minVersion \"{}\" asks for more than glTF 2.0; export as glTF 2.0",
            one_line(asset.minVersion));
}

void check_required_extensions(const GltfFile& file) {
    for (const std::string& extension : file.model.extensionsRequired)
        if (!is_supported_extension(extension))
            file.fail(
                "extensionsRequired", "{} is not supported; export without it",
                one_line(extension));
}

}  // namespace

GltfFile read_gltf_file(const fs::path& path) {
    constexpr int max_nesting = 256;
    std::vector<unsigned char> bytes = read_bytes(path);
    GltfFile file{path.filename().string(), {}};
    if (bytes.size() > std::numeric_limits<unsigned int>::max())
        throw Error(
            "{}: is larger than 4 GiB; keep buffers in .bin files beside a .gltf", file.name);
    if (is_binary(bytes)) check_glb_header(bytes, file.name);
    if (!starts_like_json(bytes))
        throw Error("{}: is not glTF; export the scene as .gltf or .glb", file.name);
    if (is_nested_deeper_than(json_text(bytes), max_nesting))
        throw Error(
            "{}: JSON is nested deeper than {} levels; export again", file.name, max_nesting);

    if (const auto json = with_placeholders(json_text(bytes), is_binary(bytes)))
        bytes = with_json(bytes, *json);
    const std::string error = parse(bytes, fs::absolute(path).parent_path(), file.model);
    // Version and extensions are known even after a failure, and often its reason: they go first.
    check_version(file);
    check_required_extensions(file);
    if (!error.empty())
        throw Error(
            "{}: not valid glTF: {}; repair the file or export again", file.name, one_line(error));
    decode_meshopt(file);
    decode_draco(file);
    return file;
}

bool is_supported_extension(std::string_view name) {
    return std::ranges::binary_search(supported_extensions, name);
}

std::string label(std::string_view kind, int index, const std::string& name) {
    return name.empty() ? fmt::format("{} {}", kind, index)
                        : fmt::format("{} {} \"{}\"", kind, index, one_line(name));
}

std::string one_line(std::string text) {
    constexpr std::size_t longest = 200;
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    if (text.size() > longest) {
        std::size_t cut = longest;
        while ((text[cut] & 0xC0) == 0x80) --cut;  // not inside a UTF-8 sequence
        text.replace(cut, text.npos, "...");
    }
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    return text;
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

double number(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::Value& object,
    const char* key,
    double missing) {
    if (!object.Has(key)) return missing;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsNumber()) file.fail(where, "{} is not a number; repair it or export again", key);
    return value.GetNumberAsDouble();
}

int integer(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::Value& object,
    const char* key,
    std::optional<int> missing) {
    if (!object.Has(key) && missing) return *missing;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsInt() || value.Get<int>() < 0)
        file.fail(where, "{} is no integer from 0 on; repair it or export again", key);
    return value.Get<int>();
}

std::vector<double> numbers(
    const GltfFile& file,
    std::string_view where,
    const tinygltf::Value& object,
    const char* key,
    const std::vector<double>& missing) {
    if (!object.Has(key)) return missing;
    const tinygltf::Value& array = object.Get(key);
    std::vector<double> values;
    for (std::size_t i = 0; i < array.ArrayLen(); ++i) {
        const tinygltf::Value& value = array.Get(static_cast<int>(i));
        if (!value.IsNumber())
            file.fail(where, "{} holds what is no number; repair it or export again", key);
        values.push_back(value.GetNumberAsDouble());
    }
    return values;
}

}  // namespace wavepath
