#include "scene/gltf_placeholders.h"

#include "scene/json_member.h"

namespace wavepath {
namespace {

using Json = nlohmann::json;

constexpr const char* meshopt = "EXT_meshopt_compression";
constexpr const char* draco = "KHR_draco_mesh_compression";

void fill_fallback_buffers(Json& root, bool binary) {
    if (!json_member(root, "buffers").is_array()) return;
    bool is_chunk = binary;
    for (Json& buffer : root["buffers"]) {
        const bool is_fallback =
            json_member(json_member(json_member(buffer, "extensions"), meshopt), "fallback") ==
            true;
        if (buffer.is_object() && (is_fallback || !(is_chunk || buffer.contains("uri")))) {
            buffer["uri"] = "data:application/octet-stream;base64,AA==";
            buffer["byteLength"] = 1;
        }
        is_chunk = false;
    }
}

void drop_draco_indices(Json& root) {
    if (!json_member(root, "meshes").is_array()) return;
    for (Json& mesh : root["meshes"]) {
        if (!json_member(mesh, "primitives").is_array()) continue;
        for (Json& primitive : mesh["primitives"])
            if (json_member(json_member(primitive, "extensions"), draco).is_object())
                primitive.erase("indices");
    }
}

}  // namespace

std::optional<std::string> with_placeholders(std::string_view text, bool binary) {
    const bool has_meshopt = text.find(meshopt) != text.npos;
    const bool has_draco = text.find(draco) != text.npos;
    if (!has_meshopt && !has_draco) return std::nullopt;
    Json root = Json::parse(text, nullptr, false);
    if (root.is_discarded()) return std::nullopt;
    if (has_meshopt) fill_fallback_buffers(root, binary);
    if (has_draco) drop_draco_indices(root);
    return root.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace wavepath
