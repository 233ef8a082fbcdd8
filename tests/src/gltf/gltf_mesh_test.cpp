#include "gltf/gltf_mesh.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <cmath>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

enum Mode { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

// Five vertices at x = 0 .. 4.
int add_five(GltfBuilder& gltf, const Json& more) {
    Json primitive = {
        {"attributes",
         {{"POSITION",
           gltf.accessor<float>("VEC3", {0, 0, 0, 1, 1, 0, 2, 0, 0, 3, 1, 0, 4, 0, 0})}}}};
    primitive.update(more);
    return gltf.object(primitive);
}

TEST(GltfMesh, TakesVerticesInOrderWithoutIndices) {
    GltfBuilder gltf;
    gltf.triangle();
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.primitives.size(), 1U);
    const Primitive& primitive = scene.primitives[0];
    EXPECT_EQ(primitive.name, "mesh 0");
    EXPECT_THAT(primitive.positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
    EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2));
    EXPECT_THAT(primitive.normals, IsEmpty());
    EXPECT_THAT(primitive.colors, IsEmpty());
    EXPECT_EQ(scene.triangle_count(), 1U);
    EXPECT_TRUE(scene.name.ends_with("/scene.gltf")) << scene.name;
    EXPECT_THAT(scene.ignored, IsEmpty());
}

TEST(GltfMesh, DropsVerticesThatCompleteNoTriangle) {
    GltfBuilder gltf;
    add_five(gltf, {{"mode", triangles}});
    EXPECT_THAT(load(gltf).primitives.at(0).indices, ElementsAre(0, 1, 2));
}

// The corners as the specification lists them: odd strip triangles are turned round.
TEST(GltfMesh, TakesStripsApart) {
    GltfBuilder gltf;
    add_five(gltf, {{"mode", triangle_strip}});
    EXPECT_THAT(load(gltf).primitives.at(0).indices, ElementsAre(0, 1, 2, 1, 3, 2, 2, 3, 4));
}

TEST(GltfMesh, TakesFansApart) {
    GltfBuilder gltf;
    add_five(gltf, {{"mode", triangle_fan}});
    EXPECT_THAT(load(gltf).primitives.at(0).indices, ElementsAre(1, 2, 0, 2, 3, 0, 3, 4, 0));
}

TEST(GltfMesh, TakesIndexedStripsApart) {
    GltfBuilder gltf;
    const int indices = gltf.accessor<std::uint8_t>("SCALAR", {4, 3, 2, 1});
    add_five(gltf, {{"mode", triangle_strip}, {"indices", indices}});
    EXPECT_THAT(load(gltf).primitives.at(0).indices, ElementsAre(4, 3, 2, 3, 1, 2));
}

TEST(GltfMesh, LeavesOutPointsAndLinesAndSaysSoOnce) {
    GltfBuilder gltf;
    for (const Mode mode : {points, lines, line_loop, line_strip}) add_five(gltf, {{"mode", mode}});
    EXPECT_THAT(load_error(gltf), HasSubstr("default scene: holds no triangles"));
    gltf.triangle();
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.triangle_count(), 1U);
    EXPECT_THAT(scene.ignored, ElementsAre("primitives of points or lines (4): left out"));
}

TEST(GltfMesh, RejectsUnknownModes) {
    GltfBuilder gltf;
    add_five(gltf, {{"mode", 7}});
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: mesh 0, primitive 0: mode 7 is unknown; export as triangles");
}

TEST(GltfMesh, LeavesOutPrimitivesWithoutPositions) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.object({{"attributes", {{"NORMAL", 0}}}});
    EXPECT_THAT(load(gltf).ignored, ElementsAre("primitives without POSITION (1): left out"));
}

TEST(GltfMesh, NormalizesNormals) {
    GltfBuilder gltf;
    const int normals = gltf.accessor<std::int8_t>(
        "VEC4", {0, 0, 127, 0, 0, 100, 0, 0, -128, 0, 0, 0},
        {{"normalized", true}, {"type", "VEC3"}});
    gltf.root["bufferViews"].back()["byteStride"] = 4;
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}, {"NORMAL", normals}}}});
    EXPECT_THAT(load(gltf).primitives.at(0).normals, ElementsAre(0, 0, 1, 0, 1, 0, -1, 0, 0));
}

TEST(GltfMesh, GivesZeroNormalsThatOfTheFace) {
    GltfBuilder gltf;
    const int normals = gltf.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 0, 0});
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}, {"NORMAL", normals}}}});
    EXPECT_THAT(load(gltf).primitives.at(0).normals, ElementsAre(0, 0, 1, 1, 0, 0, 0, 0, 1));
}

TEST(GltfMesh, ReadsColorsAndClampsThem) {
    const std::vector<float> expected{1, 0, 0.5F, 0, 1, 0.25F, 1, 0, 1};
    const auto colors = [](auto make) {
        GltfBuilder gltf;
        const int accessor = make(gltf);
        gltf.object(
            {{"attributes", {{"POSITION", gltf.triangle_positions()}, {"COLOR_0", accessor}}}});
        return load(gltf).primitives.at(0).colors;
    };
    EXPECT_EQ(
        colors([](GltfBuilder& gltf) {
            return gltf.accessor<float>("VEC3", {1, 0, 0.5F, 0, 1, 0.25F, 3, -1, 1});
        }),
        expected);
    EXPECT_EQ(
        colors([](GltfBuilder& gltf) {
            return gltf.accessor<float>("VEC4", {1, 0, 0.5F, 9, 0, 1, 0.25F, 9, 1, 0, 1, 9});
        }),
        expected);
    EXPECT_EQ(
        colors([](GltfBuilder& gltf) {
            return gltf.accessor<std::uint8_t>(
                "VEC4", {255, 0, 51, 9, 0, 255, 0, 9, 0, 0, 0, 9}, {{"normalized", true}});
        }),
        (std::vector<float>{1, 0, 0.2F, 0, 1, 0, 0, 0, 0}));
    EXPECT_EQ(
        colors([](GltfBuilder& gltf) {
            return gltf.accessor<std::uint16_t>(
                "VEC4", {65535, 0, 13107, 9, 0, 0, 0, 9, 0, 0, 0, 9}, {{"normalized", true}});
        }),
        (std::vector<float>{1, 0, 0.2F, 0, 0, 0, 0, 0, 0}));
}

// A triangle with two morph targets: the first moves x of vertex 1, the second z of vertex 0 alone,
// as sparse rows without a buffer view, and turns all normals to +X.
void add_morphed(GltfBuilder& gltf) {
    const int ones = gltf.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 0, 0});
    const int turn = gltf.accessor<float>("VEC3", {1, 0, -1, 1, 0, -1, 1, 0, -1});
    const int sparse = gltf.add(
        "accessors",
        {{"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"sparse",
          {{"count", 1},
           {"indices", {{"bufferView", gltf.view<std::uint8_t>({0})}, {"componentType", 5121}}},
           {"values", {{"bufferView", gltf.view<float>({0, 0, 1})}}}}}});
    gltf.object(
        {{"attributes",
          {{"POSITION", gltf.triangle_positions()},
           {"NORMAL", gltf.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1})}}},
         {"targets", {{{"POSITION", ones}}, {{"POSITION", sparse}, {"NORMAL", turn}}}}});
}

TEST(GltfMesh, MorphsByTheWeightsOfTheMesh) {
    GltfBuilder gltf;
    add_morphed(gltf);
    EXPECT_THAT(load(gltf).primitives.at(0).positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0))
        << "no weights: the base shape";
    gltf.root["meshes"][0]["weights"] = {-0.5, 2};
    const Scene scene = load(gltf);
    EXPECT_THAT(scene.primitives.at(0).positions, ElementsAre(0, 0, 2, 0.5F, 0, 0, 0, 1, 0));
    EXPECT_FLOAT_EQ(scene.primitives.at(0).normals[0], 2 / std::sqrt(5.0F)) << "(2, 0, -1)";
    EXPECT_THAT(scene.ignored, IsEmpty());
}

TEST(GltfMesh, MorphsByTheWeightsOfTheNodeFirst) {
    GltfBuilder gltf;
    add_morphed(gltf);
    gltf.root["meshes"][0]["weights"] = {0, 2};
    gltf.root["nodes"][0]["weights"] = {1, 0};
    gltf.node({{"mesh", 0}});
    gltf.node({{"mesh", 0}, {"weights", {1, 0}}});
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.instances.size(), 3U);
    EXPECT_EQ(scene.primitives.size(), 2U) << "one of each shape";
    EXPECT_EQ(scene.instances[0].primitive, scene.instances[2].primitive);
    EXPECT_THAT(scene.primitives[0].positions, ElementsAre(0, 0, 0, 2, 0, 0, 0, 1, 0));
    EXPECT_THAT(scene.primitives[1].positions, ElementsAre(0, 0, 2, 1, 0, 0, 0, 1, 0));
}

TEST(GltfMesh, MorphsColorsBeforeClampingThem) {
    GltfBuilder gltf;
    const int colors = gltf.accessor<float>("VEC3", {0, 0.5F, 1, 0, 0, 0, 1, 1, 1});
    const int targets = gltf.accessor<float>("VEC3", {1, -1, 1, 0, 0, 0, 0, 0, -0.5F});
    gltf.object(
        {{"attributes", {{"POSITION", gltf.triangle_positions()}, {"COLOR_0", colors}}},
         {"targets", {{{"COLOR_0", targets}}}}});
    gltf.root["meshes"][0]["weights"] = {1};
    EXPECT_THAT(load(gltf).primitives.at(0).colors, ElementsAre(1, 0, 1, 0, 0, 0, 1, 1, 0.5F));
}

// The material that the primitive names, whatever the variants' mappings offer.
TEST(GltfMesh, WearsTheDefaultOfItsVariants) {
    GltfBuilder gltf;
    gltf.add("materials", {{"name", "first"}});
    gltf.add("materials", {{"name", "default"}});
    gltf.root["extensionsUsed"] = {"KHR_materials_variants"};
    gltf.root["extensionsRequired"] = gltf.root["extensionsUsed"];
    gltf.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}};
    gltf.object(
        {{"attributes", {{"POSITION", gltf.triangle_positions()}}},
         {"material", 1},
         {"extensions",
          {{"KHR_materials_variants", {{"mappings", {{{"material", 0}, {"variants", {0}}}}}}}}}});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.materials.at(scene.primitives.at(0).material).name, "default");
    EXPECT_TRUE(scene.ignored.empty());
}

TEST(GltfMesh, RejectsBrokenMorphTargets) {
    const auto error = [](const Json& weights, const auto& breaks) {
        GltfBuilder gltf;
        add_morphed(gltf);
        gltf.root["nodes"][0]["weights"] = weights;
        breaks(gltf, gltf.root["meshes"][0]["primitives"][0]["targets"]);
        return load_error(gltf);
    };
    EXPECT_EQ(
        error({1}, [](auto&, Json&) {}),
        "scene.gltf: mesh 0, primitive 0: has 2 morph targets, but 1 weights; export again");
    EXPECT_EQ(
        error(
            {0, 1},
            [](auto& gltf, Json& targets) {
                targets[1]["POSITION"] = gltf.template accessor<float>("VEC3", {0, 0, 0});
            }),
        "scene.gltf: mesh 0, primitive 0, morph target 1, POSITION: has 1 rows, the mesh 3; repair "
        "the mesh and export again");
    EXPECT_THAT(
        error({1e39, 0}, [](auto&, Json&) {}),
        HasSubstr("morph target 0, POSITION: weight 1e+39 moves row 1 out of range"));
    EXPECT_THAT(
        error({1, 0}, [](auto&, Json& targets) { targets[0]["POSITION"] = 99; }),
        HasSubstr("morph target 0, POSITION: refers to accessor 99"));
}

TEST(GltfMesh, RejectsIntegerColorsThatAreNotNormalized) {
    GltfBuilder gltf;
    const int colors = gltf.accessor<std::uint8_t>("VEC4", std::vector<std::uint8_t>(12));
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}, {"COLOR_0", colors}}}});
    EXPECT_THAT(
        load_error(gltf), HasSubstr("primitive 0: COLOR_0 holds integers that are not normalized"));
}

TEST(GltfMesh, RejectsAttributesOfDifferentLengths) {
    GltfBuilder gltf;
    const int normals = gltf.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1});
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}, {"NORMAL", normals}}}});
    gltf.root["meshes"][0]["name"] = "lamp";
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: mesh 0 \"lamp\", primitive 0, NORMAL: has 2 rows, POSITION has 3; repair the "
        "mesh and export again");
}

TEST(GltfMesh, RejectsReferencesOutOfRange) {
    GltfBuilder accessor;
    accessor.object({{"attributes", {{"POSITION", 5}}}});
    EXPECT_THAT(
        load_error(accessor), HasSubstr("POSITION: refers to accessor 5, but the file has 0"));

    GltfBuilder material;
    material.object(
        {{"attributes", {{"POSITION", material.triangle_positions()}}}, {"material", 0}});
    EXPECT_THAT(
        load_error(material), HasSubstr("primitive 0: refers to material 0, but the file has 0"));
}

TEST(GltfMesh, KeepsNamesOnOneLine) {
    GltfBuilder gltf;
    add_five(gltf, {{"mode", 9}});
    gltf.root["meshes"][0]["name"] = "two\nlines";
    EXPECT_THAT(load_error(gltf), HasSubstr("mesh 0 \"two lines\", primitive 0: mode 9"));
}

}  // namespace
}  // namespace wavepath
