#include "scene/gltf_unresolved.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace wavepath {
namespace {

using Json = nlohmann::json;

// Array or object `key` of `object`, or an empty one.
Json member(const Json& object, const char* key) {
    return object.is_object() ? object.value(key, Json()) : Json();
}

bool is_missing(const Json& accessor, std::size_t count) {
    return accessor.is_number_integer() &&
           (accessor.get<int64_t>() < 0 || accessor.get<uint64_t>() >= count);
}

}  // namespace

std::string unresolved_accessor(std::string_view text) {
    const Json root = Json::parse(text, nullptr, false);
    const std::size_t count = member(root, "accessors").size();
    std::size_t m = 0;
    for (const Json& mesh : member(root, "meshes")) {
        std::size_t p = 0;
        for (const Json& primitive : member(mesh, "primitives")) {
            Json uses = member(primitive, "attributes");
            if (!uses.is_object()) uses = Json::object();
            if (primitive.is_object() && primitive.contains("indices"))
                uses["indices"] = primitive["indices"];
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
