#include "gltf/gltf_placeholders.h"

#include <nlohmann/json.hpp>

namespace wavepath {
namespace {

using Json = nlohmann::json;

Json& array_of(Json& object, const char* key) {
    static Json none = Json::array();
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

}  // namespace

std::vector<int> put_placeholders(Json& root) {
    for (Json& animation : array_of(root, "animations")) animation = Json::object();
    for (Json& skin : array_of(root, "skins")) skin.emplace("inverseBindMatrices", -1);
    std::vector<int> indices;
    for (Json& mesh : array_of(root, "meshes"))
        for (Json& primitive : array_of(mesh, "primitives")) {
            indices.push_back(primitive.value("indices", -1));
            primitive.erase("indices");
        }
    return indices;
}

void put_indices_back(const std::vector<int>& indices, tinygltf::Model& model) {
    auto next = indices.begin();
    for (tinygltf::Mesh& mesh : model.meshes)
        for (tinygltf::Primitive& primitive : mesh.primitives) primitive.indices = *next++;
}

}  // namespace wavepath
