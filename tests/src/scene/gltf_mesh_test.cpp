#include "scene/gltf_mesh.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

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
    EXPECT_EQ(scene.name, "scene");
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
