#include "gltf/gltf_attributes.h"

#include "gltf/gltf_accessor.h"
#include "gltf/tangents.h"

#include <algorithm>

namespace wavepath {
namespace {

class AttributeReader {
  public:
    AttributeReader(
        const GltfFile& file,
        const tinygltf::Primitive& source,
        std::string_view where,
        std::size_t vertex_count)
        : file_(file), source_(source), where_(where), vertex_count_(vertex_count) {}

    // `width` floats a vertex; empty where the mesh has no such attribute.
    std::vector<float> read(const std::string& name, std::size_t width) const {
        return read_attribute(file_, source_, name, width, vertex_count_, where_)
            .value_or(std::vector<float>{});
    }

    // The fourth component of COLOR_0, where it has one that says something.
    std::vector<float> alphas() const {
        const auto found = source_.attributes.find("COLOR_0");
        if (found == source_.attributes.end()) return {};
        const auto& accessor = file_.at(file_.model.accessors, found->second, "accessor", where_);
        if (accessor.type != TINYGLTF_TYPE_VEC4) return {};
        const std::vector<float> colors = read("COLOR_0", 4);
        std::vector<float> alphas;
        for (std::size_t i = 3; i < colors.size(); i += 4)
            alphas.push_back(std::clamp(colors[i], 0.0F, 1.0F));
        const bool covered = std::ranges::all_of(alphas, [](float a) { return a == 1; });
        return covered ? std::vector<float>{} : alphas;
    }

  private:
    const GltfFile& file_;
    const tinygltf::Primitive& source_;
    std::string_view where_;
    std::size_t vertex_count_;
};

}  // namespace

void read_surface_attributes(
    const GltfFile& file,
    const tinygltf::Primitive& source,
    const Material& material,
    std::string_view where,
    bool bent,
    Primitive& primitive,
    Ignored& ignored) {
    const std::size_t vertex_count = primitive.positions.size() / 3;
    const AttributeReader reader(file, source, where, vertex_count);
    for (std::size_t i = 0; i < material.uv_sets.size(); ++i) {
        auto& uvs = primitive.uvs[i];
        uvs = reader.read(fmt::format("TEXCOORD_{}", material.uv_sets[i]), 2);
        if (uvs.empty()) {
            ignored.add("meshes without the texture coordinates they need", "rendered with (0, 0)");
            uvs.assign(2 * vertex_count, 0.0F);
        }
    }
    if (material.alpha_mode != AlphaMode::opaque) primitive.alphas = reader.alphas();
    if (material.has(TEXTURE_NORMAL)) {
        // without normals the given tangents are void [glTF 2.0, section 3.7.2.1]
        const std::vector<float> given =
            primitive.normals.empty() || bent ? std::vector<float>{} : reader.read("TANGENT", 4);
        primitive.tangents =
            given.empty()
                ? derive_tangents(primitive, primitive.uvs[material.texture(TEXTURE_NORMAL).uvs])
                : expand_tangents(primitive, given);
    }
}

}  // namespace wavepath
