#include "gltf/gltf_file.h"

#include "gltf/gltf_container.h"
#include "gltf/gltf_data.h"
#include "gltf/gltf_draco.h"
#include "gltf/gltf_meshopt.h"
#include "gltf/gltf_placeholders.h"
#include "gltf/gltf_schema.h"
#include "gltf/json_member.h"

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
using Json = nlohmann::json;

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

// What these say shows in no still picture. Sorted.
constexpr auto extensions_without_effect = std::to_array<std::string_view>({
    "AGI_stk_metadata",         // sensors and solar panels, for a simulation
    "EXT_instance_features",    // numbers of features of instances
    "EXT_mesh_features",        // numbers of features of vertices and texels
    "EXT_mesh_manifold",        // which edges of a mesh meet
    "EXT_structural_metadata",  // tables of features' properties
    "FB_geometry_metadata",     // bounds and counts of a scene
    "GODOT_single_root",        // how to import the nodes
    "FB_ngon_encoding",         // which triangles were one polygon
    "GRIFFEL_bim_data",         // properties of building parts
    "KHR_animation_pointer",    // what animations move: rendered at rest
    "KHR_interactivity",        // what happens when a user acts
    "KHR_node_hoverability",    // which nodes a pointer meets
    "KHR_node_selectability",   // which nodes a user may select
    "KHR_xmp",                  // authors, rights, history
    "KHR_xmp_json_ld",          // the same
    "MAXAR_image_ortho",        // how images lie on the earth
    "MSFT_lod",                 // coarser stand-ins for nodes and materials
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

Json parse_json(std::string_view text, const std::string& name) {
    constexpr int max_nesting = 256;
    if (!starts_like_json(text))
        throw Error("{}: is not glTF; export the scene as .gltf or .glb", name);
    if (is_nested_deeper_than(text, max_nesting))
        throw Error("{}: JSON is nested deeper than {} levels; export again", name, max_nesting);
    try {
        return Json::parse(text);
    } catch (const Json::exception& exception) {
        throw Error(
            "{}: not valid glTF: {}; repair the file or export again", name,
            one_line(exception.what()));
    }
}

// `root` as tinygltf's model, but for what take_data has put there.
void parse_model(Json root, GltfFile& file) {
    const std::vector<int> indices = put_placeholders(root);
    const std::string text = root.dump();
    tinygltf::Model model;
    std::string error, warning;
    try {
        tinygltf::TinyGLTF parser;
        const bool parsed = parser.LoadASCIIFromString(
            &model, &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()), "");
        if (!parsed && error.empty()) error = "it cannot be parsed";
    } catch (const std::exception& exception) {
        error = fmt::format("it cannot be parsed ({})", exception.what());
    }
    if (!error.empty())  // also where it claims success
        throw Error(
            "{}: not valid glTF: {}; repair the file or export again", file.name, one_line(error));
    put_indices_back(indices, model);
    model.buffers = std::move(file.model.buffers);
    model.images = std::move(file.model.images);
    file.model = std::move(model);
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
void check_version(const Json& root, const GltfFile& file) {
    const Json& asset = json_member(root, "asset");
    if (!json_member(asset, "version").is_string()) return;  // is said with the other types
    const std::string text = json_text(asset, "version");
    const auto version = parse_version(text);
    if (!version || version->first != 2)
        file.fail("asset", "version \"{}\" is not supported; export as glTF 2.0", one_line(text));
    const std::string least = json_text(asset, "minVersion");
    if (least.empty()) return;
    const auto needed = parse_version(least);
    if (!needed || *needed > Version{2, 0})
        file.fail(
            "asset", "minVersion \"{}\" asks for more than glTF 2.0; export as glTF 2.0",
            one_line(least));
}

void check_required_extensions(const Json& root, const GltfFile& file) {
    const Json& required = json_member(root, "extensionsRequired");
    if (!required.is_array()) return;  // is said with the other types
    for (const Json& name : required)
        if (name.is_string() && !is_supported_extension(name.get<std::string>()))
            file.fail(
                "extensionsRequired", "{} is not supported; export without it",
                one_line(name.get<std::string>()));
}

}  // namespace

GltfFile read_gltf_file(const fs::path& path) {
    const std::vector<unsigned char> bytes = read_bytes(path);
    GltfFile file{path.filename().string(), {}, {}, {}};
    if (bytes.size() > std::numeric_limits<unsigned int>::max())
        throw Error(
            "{}: is larger than 4 GiB; keep buffers in .bin files beside a .gltf", file.name);
    const GltfContainer container = open_container(bytes, file.name);
    Json root = parse_json(container.json, file.name);
    // Version and extensions are often the reason of what else is wrong: they go first.
    check_version(root, file);
    check_required_extensions(root, file);
    if (const std::string wrong = put_types_right(root); !wrong.empty())
        throw Error("{}: {}; repair the file or export again", file.name, wrong);
    take_data(root, fs::absolute(path).parent_path(), container.chunk, file);
    parse_model(std::move(root), file);
    decode_meshopt(file);
    decode_draco(file);
    return file;
}

bool is_supported_extension(std::string_view name) {
    return std::ranges::binary_search(supported_extensions, name) ||
           std::ranges::binary_search(extensions_without_effect, name);
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
