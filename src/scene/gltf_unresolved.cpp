#include "scene/gltf_unresolved.h"

#include "scene/json_member.h"

#include <fmt/format.h>

namespace wavepath {
namespace {

using Json = nlohmann::json;

bool is_missing(const Json& accessor, std::size_t count) {
    return accessor.is_number_integer() &&
           (accessor.get<int64_t>() < 0 || accessor.get<uint64_t>() >= count);
}

}  // namespace

std::string unresolved_accessor(std::string_view text) {
    const Json root = Json::parse(text, nullptr, false);
    const std::size_t count = json_member(root, "accessors").size();
    std::size_t m = 0;
    for (const Json& mesh : json_member(root, "meshes")) {
        std::size_t p = 0;
        for (const Json& primitive : json_member(mesh, "primitives")) {
            Json uses = json_member(primitive, "attributes");
            if (!uses.is_object()) uses = Json::object();
            uses["indices"] = json_member(primitive, "indices");
            for (const auto& [name, accessor] : uses.items())
                if (is_missing(accessor, count))
                    return fmt::format(
                        "mesh {}, primitive {}: {} names accessor {}, there are {}", m, p, name,
                        accessor.dump(), count);
            ++p;
        }
        ++m;
    }
    return "";
}

}  // namespace wavepath
