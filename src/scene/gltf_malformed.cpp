#include "scene/gltf_malformed.h"

#include "scene/gltf_file.h"
#include "scene/json_member.h"

namespace wavepath {
namespace {

using Json = nlohmann::json;

std::string malformed(const Json& value, const std::string& path);

// Of extensions that this program knows.
std::string malformed_extensions(const Json& extensions, const std::string& path) {
    if (!extensions.is_object()) return path + " is no object";
    for (const auto& [name, extension] : extensions.items()) {
        if (!is_supported_extension(name)) continue;
        const std::string inner = fmt::format("{}.{}", path, name);
        if (!extension.is_object()) return inner + " is no object";
        if (std::string found = malformed(extension, inner); !found.empty()) return found;
    }
    return "";
}

std::string malformed(const Json& value, const std::string& path) {
    if (value.is_null()) return path + " is null";
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            if (std::string found = malformed(value[i], fmt::format("{}[{}]", path, i));
                !found.empty())
                return found;
    if (!value.is_object()) return "";
    for (const auto& [key, member] : value.items()) {
        const std::string inner = fmt::format("{}.{}", path, one_line(key));
        std::string found;
        if (key == "extensions")
            found = malformed_extensions(member, inner);
        else if (key != "extras")
            found = malformed(member, inner);
        else if (member.is_object() && member.contains("wavepath_medium"))
            found = malformed(member["wavepath_medium"], inner + ".wavepath_medium");
        if (!found.empty()) return found;
    }
    return "";
}

}  // namespace

std::string malformed_material(std::string_view json) {
    const Json root = Json::parse(json, nullptr, false);
    const Json& materials = json_member(root, "materials");
    if (!materials.is_array()) return "";
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (std::string found = malformed(materials[m], fmt::format("materials[{}]", m));
            !found.empty())
            return found;
    return "";
}

}  // namespace wavepath
