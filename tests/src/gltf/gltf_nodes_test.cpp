#include "gltf/gltf_nodes.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <cmath>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;

// World transform of a triangle whose node has these properties too.
Matrix4 placed(const Json& properties) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["nodes"][0].update(properties);
    return load(gltf).instances.at(0).to_world;
}

std::string placing_error(const Json& properties) {
    return error_of([&] { placed(properties); });
}

TEST(GltfNodes, ScalesThenRotatesThenTranslates) {
    const double half = std::sqrt(0.5);  // a quarter turn about +Z takes x to y
    const Matrix4 expected{0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1};
    EXPECT_THAT(
        placed(
            {{"translation", {5, 6, 7}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}}),
        Pointwise(DoubleNear(1e-15), expected));
    EXPECT_THAT(
        placed({{"translation", {5, 6, 7}}, {"rotation", {0, 0, 3, 3}}, {"scale", {2, 3, 4}}}),
        Pointwise(DoubleNear(1e-15), expected))
        << "a quaternion that is not unit";
    const Matrix4 about_x = placed({{"rotation", {half, 0, 0, half}}});
    EXPECT_THAT(
        about_x,
        Pointwise(DoubleNear(1e-15), Matrix4{1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1}));
    const Matrix4 about_y = placed({{"rotation", {0, half, 0, half}}});
    EXPECT_THAT(
        about_y,
        Pointwise(DoubleNear(1e-15), Matrix4{0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}));
}

TEST(GltfNodes, TakesMatricesColumnByColumn) {
    const Matrix4 matrix{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 10, 0, 11, 12, 13, 1};
    EXPECT_EQ(placed({{"matrix", matrix}}), matrix);
}

TEST(GltfNodes, KeepsMirroringScales) {
    const Matrix4 expected{-1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1};
    EXPECT_EQ(placed({{"scale", {-1, 2, 3}}}), expected);
}

TEST(GltfNodes, MultipliesParentsInDouble) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["nodes"][0]["translation"] = {1e-9, 0, 0};
    gltf.root["scenes"][0]["nodes"] = {1};
    gltf.root["nodes"].push_back(
        {{"children", {0}}, {"scale", {2, 2, 2}}, {"translation", {1000, 0, 0}}});
    EXPECT_EQ(load(gltf).instances.at(0).to_world[12], 1000 + 2e-9);
}

TEST(GltfNodes, SharesMeshesBetweenInstances) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.node({{"mesh", 0}, {"translation", {0, 0, 1}}});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.primitives.size(), 1U);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.instances[1].to_world[14], 1);
    EXPECT_EQ(scene.triangle_count(), 2U);
}

// x of every instance, in order.
std::vector<double> places(const Scene& scene) {
    std::vector<double> result;
    for (const Instance& instance : scene.instances) result.push_back(instance.to_world[12]);
    return result;
}

TEST(GltfNodes, GoesDepthFirst) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["nodes"] = {
        {{"children", {1, 4}}},
        {{"mesh", 0}, {"translation", {1, 0, 0}}, {"children", {2, 3}}},
        {{"mesh", 0}, {"translation", {1, 0, 0}}},
        {{"mesh", 0}, {"translation", {2, 0, 0}}},
        {{"mesh", 0}, {"translation", {4, 0, 0}}},
        {{"mesh", 0}, {"translation", {5, 0, 0}}}};
    gltf.root["scenes"][0]["nodes"] = {0, 5};
    EXPECT_THAT(places(load(gltf)), ElementsAre(1, 2, 3, 4, 5));
}

TEST(GltfNodes, ChoosesTheScene) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["nodes"] = {
        {{"mesh", 0}, {"translation", {1, 0, 0}}}, {{"mesh", 0}, {"translation", {2, 0, 0}}}};
    gltf.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    gltf.root["scene"] = 1;
    EXPECT_THAT(places(load(gltf)), ElementsAre(2)) << "the default scene";
    gltf.root.erase("scene");
    EXPECT_THAT(places(load(gltf)), ElementsAre(1)) << "the first scene";
    gltf.root.erase("scenes");
    EXPECT_THAT(places(load(gltf)), ElementsAre(1, 2)) << "no scene: every node";
    gltf.root["scene"] = 0;
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: default scene: refers to scene 0, but the file has 0 of them; repair the "
        "index "
        "or export again");
}

TEST(GltfNodes, ChoosesTheSceneAskedFor) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["nodes"] = {
        {{"mesh", 0}, {"translation", {1, 0, 0}}}, {{"mesh", 0}, {"translation", {2, 0, 0}}}};
    gltf.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}, {"name", "0"}}, {{"name", "empty"}}};
    const TemporaryFolder folder;
    const auto file = folder.write("scene.gltf", gltf.text());
    EXPECT_THAT(places(load_gltf(file, "1")), ElementsAre(2)) << "by index";
    EXPECT_THAT(places(load_gltf(file, "0")), ElementsAre(2)) << "a name goes before an index";
    EXPECT_THAT(places(load_gltf(file)), ElementsAre(1)) << "the default scene";
    EXPECT_EQ(
        error_of([&] { load_gltf(file, "3"); }),
        "--scene 3: scene.gltf has 3 scene(s): scene 0, scene 1 \"0\", scene 2 \"empty\"; name one "
        "of them by index or name");
    EXPECT_THAT(
        error_of([&] { load_gltf(file, "-1"); }), HasSubstr("--scene -1: scene.gltf has 3"));
    EXPECT_EQ(
        error_of([&] { load_gltf(file, "empty"); }),
        "scene.gltf: scene empty: holds no triangles; add a mesh to it or choose another --scene");
    gltf.root.erase("scenes");
    gltf.root.erase("scene");
    EXPECT_EQ(
        error_of([&] { load_gltf(folder.write("scene.gltf", gltf.text()), "0"); }),
        "--scene 0: scene.gltf has 0 scene(s); name one of them by index or name");
}

// Of a hidden subtree neither meshes nor lights are seen, but cameras see [KHR_node_visibility].
TEST(GltfNodes, HidesSubtrees) {
    const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
    const Json shown = {{"KHR_node_visibility", {{"visible", true}}}};
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["extensionsUsed"] = {"KHR_lights_punctual", "KHR_node_visibility"};
    gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    gltf.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    const Json light = {{"light", 0}};
    gltf.root["nodes"] = {
        {{"mesh", 0}, {"translation", {1, 0, 0}}, {"extensions", shown}},
        {{"mesh", 0}, {"translation", {2, 0, 0}}, {"extensions", hidden}, {"children", {2, 3, 4}}},
        {{"mesh", 0}, {"extensions", shown}},
        {{"camera", 0}},
        {{"extensions", {{"KHR_lights_punctual", light}}}},
        {{"extensions",
          {{"KHR_lights_punctual", light}, {"KHR_node_visibility", Json::object()}}}}};
    gltf.root["scenes"][0]["nodes"] = {0, 1, 5};
    const Scene scene = load(gltf);
    EXPECT_THAT(places(scene), ElementsAre(1));
    EXPECT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.lights.size(), 1U);
    EXPECT_THAT(scene.ignored, IsEmpty());
    gltf.root["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = 0;
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: node 1: extensions.KHR_node_visibility.visible is 0, not true or false; "
        "repair "
        "the file or export again");
}

TEST(GltfNodes, JudgesOnlyWhatTheSceneReaches) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["nodes"].push_back({{"mesh", 99}, {"children", {1}}});
    gltf.root["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 99}}}}}}});
    EXPECT_EQ(load_error(gltf), "");
}

TEST(GltfNodes, WalksDeepTrees) {
    GltfBuilder gltf;
    gltf.triangle();
    constexpr int depth = 20000;
    for (int i = 1; i <= depth; ++i)
        gltf.root["nodes"].push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
    gltf.root["nodes"].push_back({{"mesh", 0}});
    gltf.root["scenes"][0]["nodes"] = {1};
    EXPECT_THAT(places(load(gltf)), ElementsAre(depth));
}

TEST(GltfNodes, HidesWhatIsScaledToNothing) {
    for (const Json& scale : {Json{0, 0, 0}, Json{0, 0, 3}}) {
        GltfBuilder gltf;
        gltf.triangle();
        gltf.triangle();
        gltf.root["nodes"][0]["scale"] = scale;
        EXPECT_EQ(load(gltf).instances.size(), 1U);
    }
    EXPECT_EQ(placed({{"scale", {1, 1, 0}}})[10], 0) << "a flat object still has an area";
}

TEST(GltfNodes, RejectsWhatIsNoTree) {
    const auto error = [](const Json& nodes, const Json& roots) {
        GltfBuilder gltf;
        gltf.triangle();
        gltf.root["nodes"] = nodes;
        gltf.root["scenes"][0]["nodes"] = roots;
        if (roots.is_null()) gltf.root.erase("scenes"), gltf.root.erase("scene");
        return load_error(gltf);
    };
    EXPECT_EQ(
        error({{{"children", {1}}, {"name", "a"}}, {{"children", {0}}, {"name", "b"}}}, {0}),
        "scene.gltf: node 1 \"b\": node 0 is met a second time, nodes must form a tree; give each "
        "one "
        "parent");
    EXPECT_THAT(
        error({{{"children", {0}}}}, {0}), HasSubstr("node 0: node 0 is met a second time"));
    EXPECT_THAT(
        error({{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}}, {0, 1}),
        HasSubstr("node 2 is met a second time"));
    EXPECT_THAT(error({{{"mesh", 0}}}, {0, 0}), HasSubstr("scene 0: node 0 is met a second time"));
    EXPECT_THAT(
        error({{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}}, nullptr),
        HasSubstr("nodes: some are their own ancestors"));
}

TEST(GltfNodes, RejectsReferencesOutOfRange) {
    EXPECT_EQ(
        placing_error({{"children", {7}}, {"name", "arm"}}),
        "scene.gltf: node 0 \"arm\": refers to node 7, but the file has 1 of them; repair the "
        "index or "
        "export again");
    EXPECT_THAT(
        placing_error({{"children", {-1}}}), HasSubstr("children[0] is -1, not an integer"));
    EXPECT_THAT(placing_error({{"mesh", 3}}), HasSubstr("node 0: refers to mesh 3"));
    EXPECT_THAT(placing_error({{"camera", 0}}), HasSubstr("node 0: refers to camera 0"));
}

// Products of matrices in single precision.
TEST(GltfNodes, ForgivesARoundedLastRow) {
    const auto placed = [](const Json& matrix) {
        GltfBuilder gltf;
        gltf.triangle();
        gltf.root["nodes"][0]["matrix"] = matrix;
        return load(gltf).instances.at(0).to_world;
    };
    const Matrix4 exact{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1};
    for (const Json& matrix :
         {Json{2, 0, 0, 1e-17, 0, 2, 0, -5.96e-8, 0, 0, 2, 0, 5, 6, 7, 1},
          Json{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, -0.0, 5, 6, 7, 0.99999994},
          Json{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1.0000001}})
        EXPECT_EQ(placed(matrix), exact) << matrix;
}

TEST(GltfNodes, RejectsBrokenTransforms) {
    EXPECT_THAT(
        placing_error({{"matrix", {1, 2}}}), HasSubstr("matrix has 2 numbers instead of 16"));
    EXPECT_THAT(placing_error({{"scale", {1, 2}}}), HasSubstr("scale has 2 numbers instead of 3"));
    EXPECT_THAT(
        placing_error({{"rotation", {0, 0, 0, 0}}}), HasSubstr("rotation is the zero quaternion"));
    EXPECT_THAT(
        placing_error({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}}}),
        HasSubstr("the last row of matrix is not 0 0 0 1"));
    EXPECT_THAT(
        placing_error({{"matrix", {1, 0, 0, 2e-6, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}),
        HasSubstr("the last row of matrix is not 0 0 0 1"));
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["nodes"][0]["scale"] = {1e300, 1, 1};
    gltf.root["nodes"].push_back({{"children", {0}}, {"scale", {1e300, 1, 1}}});
    gltf.root["scenes"][0]["nodes"] = {1};
    EXPECT_THAT(load_error(gltf), HasSubstr("node 0: its transform is not finite"));
}

}  // namespace
}  // namespace wavepath
