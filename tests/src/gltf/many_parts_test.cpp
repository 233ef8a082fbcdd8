// Assemblies of thousands of parts, as CAD programs write them.
#include "support/gltf_builder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;

// A mesh of one triangle with accessors and a material of its own.
int add_part(GltfBuilder& gltf, unsigned part) {
    const int positions = gltf.triangle_positions();
    const int indices = gltf.accessor<std::uint16_t>("SCALAR", {0, 1, 2});
    const int material = gltf.add(
        "materials",
        {{"pbrMetallicRoughness", {{"baseColorFactor", {.2 + .1 * (part % 7), .5, .5, 1}}}}});
    return gltf.add(
        "meshes", {{"primitives",
                    {{{"attributes", {{"POSITION", positions}}},
                      {"indices", indices},
                      {"material", material}}}}});
}

// `parts` of them in groups of ten, of tens, and so on, each a metre further along x.
std::string assembly(unsigned parts, bool shared) {
    GltfBuilder gltf;
    const int first = shared ? add_part(gltf, 0) : 0;
    std::vector<int> nodes;
    for (unsigned i = 0; i < parts; ++i)
        nodes.push_back(gltf.add(
            "nodes",
            {{"mesh", shared ? first : add_part(gltf, i)}, {"translation", {1. * i, 0, 0}}}));
    while (nodes.size() > 10) {
        std::vector<int> groups;
        for (std::size_t i = 0; i < nodes.size(); i += 10) {
            const std::size_t end = std::min(i + 10, nodes.size());
            Json children = Json::array();
            for (std::size_t k = i; k < end; ++k) children.push_back(nodes[k]);
            groups.push_back(gltf.add("nodes", {{"children", children}}));
        }
        nodes = groups;
    }
    gltf.root["scenes"][0]["nodes"] = nodes;
    return gltf.binary();
}

TEST(ManyParts, AreAllThere) {
    constexpr unsigned parts = 2345;
    const TemporaryFolder folder;
    for (const bool shared : {false, true}) {
        const Scene scene = load_gltf(folder.write("a.glb", assembly(parts, shared)));
        ASSERT_EQ(scene.instances.size(), parts);
        EXPECT_EQ(scene.primitives.size(), shared ? 1 : parts);
        EXPECT_EQ(scene.triangle_count(), parts);
        for (unsigned i = 0; i < parts; ++i) {
            const Instance& instance = scene.instances[i];
            ASSERT_EQ(instance.to_world[12], i);
            const Rgb& color =
                scene.materials[scene.primitives[instance.primitive].material].base_color;
            ASSERT_FLOAT_EQ(color[0], .2F + .1F * static_cast<float>(shared ? 0 : i % 7)) << i;
        }
    }
}

}  // namespace
}  // namespace wavepath
