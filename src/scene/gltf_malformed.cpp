#include "scene/gltf_malformed.h"

#include "scene/gltf_file.h"
#include "scene/json_member.h"

namespace wavepath {
namespace {

using Json = nlohmann::json;

std::string first_null(const Json& value, const std::string& path) {
    if (value.is_null()) return path + " is null";
    if (!value.is_structured()) return "";
    for (const auto& [key, member] : value.items()) {
        const bool foreign = path.ends_with(".extras") && key != "wavepath_medium";
        const std::string inner = value.is_array() ? fmt::format("{}[{}]", path, key)
                                                   : fmt::format("{}.{}", path, one_line(key));
        if (std::string found = foreign ? "" : first_null(member, inner); !found.empty())
            return found;
    }
    return "";
}

}  // namespace

std::string malformed_material(std::string_view json) {
    const Json root = Json::parse(json, nullptr, false);
    const Json& materials = json_member(root, "materials");
    if (!materials.is_array()) return "";
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const std::string where = fmt::format("materials[{}]", m);
        for (const auto& [name, extension] : json_member(materials[m], "extensions").items())
            if (!extension.is_object())
                return fmt::format("{}.extensions.{} is no object", where, one_line(name));
        if (std::string found = first_null(materials[m], where); !found.empty()) return found;
    }
    return "";
}

}  // namespace wavepath
