#include "scene/gltf_file.h"

#include "scene/gltf_container.h"
#include "scene/gltf_draco.h"
#include "scene/gltf_malformed.h"
#include "scene/gltf_meshopt.h"
#include "scene/gltf_placeholders.h"
#include "scene/gltf_unresolved.h"

#include <algorithm>
#include <array>
#include <charconv>
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
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_scatter",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
});

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

// tinygltf looks in the working directory too, as "./name": what is rendered must not depend on it.
bool is_file_beside_scene(const std::string& path, void*) {
    std::error_code status;
    return fs::path(path).is_absolute() && fs::is_regular_file(path, status);
}

// Notes the file in a std::vector<fs::path>.
bool read_and_note(
    std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void* files) {
    static_cast<std::vector<fs::path>*>(files)->emplace_back(path);
    return tinygltf::ReadWholeFile(bytes, error, path, nullptr);
}

[[maybe_unused]] bool measure(
    std::size_t* bytes, std::string* error, const std::string& path, void*) {
    std::error_code status;
    *bytes = fs::file_size(path, status);
    if (status) *error += fmt::format("{}: {}\n", path, status.message());
    return !status;
}

// How tinygltf gets at files; those it reads are noted in `files`. From 2.9 on it asks for their
// size as well, and takes all callbacks or none.
template <typename Callbacks = tinygltf::FsCallbacks>
Callbacks access_noted_in(std::vector<fs::path>& files) {
    Callbacks access{};
    access.FileExists = is_file_beside_scene;
    access.ExpandFilePath = tinygltf::ExpandFilePath;
    access.ReadWholeFile = read_and_note;
    access.WriteWholeFile = tinygltf::WriteWholeFile;
    if constexpr (requires { access.GetFileSizeInBytes; }) access.GetFileSizeInBytes = measure;
    access.user_data = &files;
    return access;
}

// tinygltf would decode every image while it parses, and fail for one that it cannot decode. Those
// in buffer views are left there: their range has not been checked yet.
bool leave_image_encoded(
    tinygltf::Image* image,
    int,
    std::string*,
    std::string*,
    int,
    int,
    const unsigned char* bytes,
    int size,
    void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

// tinygltf takes data URIs of types that it does not know for names of files.
void decode_data_uris(tinygltf::Model& model) {
    for (tinygltf::Image& image : model.images) {
        const std::size_t comma = image.uri.find(',');
        if (!image.uri.starts_with("data:") || comma == image.uri.npos) continue;
        const std::string known = "data:application/octet-stream;base64" + image.uri.substr(comma);
        std::string type;
        tinygltf::DecodeDataURI(&image.image, type, known, 0, false);
        image.uri.clear();
    }
}

// glTF does not require these matrices [glTF 2.0, section 5.28], tinygltf does.
void forgive_skins(std::string& error) {
    constexpr std::string_view complaint = "'inverseBindMatrices' property is missing in Skin.\n";
    for (auto at = error.find(complaint); at != error.npos; at = error.find(complaint))
        error.erase(at, complaint.size());
}

// What tinygltf holds against the file, also where it claims success; empty: nothing.
std::string parse(std::span<const unsigned char> bytes, const fs::path& folder, GltfFile& file) {
    tinygltf::Model& model = file.model;
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(leave_image_encoded, nullptr);
    parser.SetFsCallbacks(access_noted_in(file.files));
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
        decode_data_uris(model);
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
    GltfFile file{path.filename().string(), {}, {}};
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
    const std::string error = parse(bytes, fs::absolute(path).parent_path(), file);
    // Version and extensions are known even after a failure, and often its reason: they go first.
    check_version(file);
    check_required_extensions(file);
    if (!error.empty()) {
        const bool of_accessor = error.find("accessor") != error.npos;
        const std::string unresolved = of_accessor ? unresolved_accessor(json_text(bytes)) : "";
        throw Error(
            "{}: not valid glTF: {}; repair the file or export again", file.name,
            one_line(unresolved.empty() ? error : unresolved));
    }
    if (const std::string malformed = malformed_material(json_text(bytes)); !malformed.empty())
        throw Error("{}: {}; repair the file or export again", file.name, malformed);
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
    if (!array.IsArray()) file.fail(where, "{} is not an array of numbers; repair it", key);
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
