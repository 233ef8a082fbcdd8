#include "gltf/gltf_skin.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <cmath>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;

// The triangle (0 0 0) (1 0 0) (0 1 0) with normals +Z, bent by two joints: node 1, which moves by
// (10, 0, 0), and its child node 2, which turns a quarter about +Z and moves by (0, 10, 0) more.
struct SkinnedTriangle : GltfBuilder {
    SkinnedTriangle(const Json& joints_and_weights) {
        Json attributes = {
            {"POSITION", triangle_positions()},
            {"NORMAL", accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1})}};
        attributes.update(joints_and_weights);
        object({{"attributes", attributes}});
        const double half = std::sqrt(0.5);
        root["nodes"][0].update({{"skin", 0}, {"translation", {99, 99, 99}}});
        root["nodes"].push_back({{"translation", {10, 0, 0}}, {"children", {2}}});
        root["nodes"].push_back({{"translation", {0, 10, 0}}, {"rotation", {0, 0, half, half}}});
        root["scenes"][0]["nodes"].push_back(1);
        root["skins"] = {{{"joints", {1, 2}}}};
    }
};

// Vertex 0 follows joint 0, vertex 1 joint 1, vertex 2 both alike.
Json two_joints(GltfBuilder& gltf) {
    return {
        {"JOINTS_0", gltf.accessor<std::uint8_t>("VEC4", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0})},
        {"WEIGHTS_0", gltf.accessor<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, .5F, .5F, 0, 0})}};
}

std::vector<float> world_positions(const Scene& scene) {
    const Instance& instance = scene.instances.at(0);
    std::vector<float> positions = scene.primitives.at(instance.primitive).positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] += static_cast<float>(instance.to_world[12 + i % 3]);
    return positions;
}

// Joint 0 takes p to p + (10, 0, 0); joint 1 takes (x, y, z) to (10 - y, 10 + x, z).
const std::vector<float> bent{10, 0, 0, 10, 11, 0, 9.5F, 5.5F, 0};

template <typename Make>
std::vector<float> bend(const Make& make) {
    GltfBuilder buffers;
    SkinnedTriangle gltf(Json::object());
    gltf.root["meshes"][0]["primitives"][0]["attributes"].update(make(gltf));
    return world_positions(load(gltf));
}

TEST(GltfSkin, FollowsTheJointsAndNotItsNode) {
    EXPECT_THAT(bend(two_joints), Pointwise(FloatNear(2e-6F), bent));
}

TEST(GltfSkin, ReadsEveryEncoding) {
    EXPECT_THAT(
        bend([](GltfBuilder& gltf) {
            return Json{
                {"JOINTS_0",
                 gltf.accessor<std::uint16_t>("VEC4", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0})},
                {"WEIGHTS_0", gltf.accessor<std::uint8_t>(
                                  "VEC4", {255, 0, 0, 0, 255, 0, 0, 0, 128, 128, 0, 0},
                                  {{"normalized", true}})}};
        }),
        Pointwise(FloatNear(2e-6F), bent));
    EXPECT_THAT(
        bend([](GltfBuilder& gltf) {
            return Json{
                {"JOINTS_0",
                 gltf.accessor<std::uint8_t>("VEC4", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0})},
                {"WEIGHTS_0", gltf.accessor<std::uint16_t>(
                                  "VEC4", {65535, 0, 0, 0, 65535, 0, 0, 0, 40, 40, 0, 0},
                                  {{"normalized", true}})}};
        }),
        Pointwise(FloatNear(2e-6F), bent));
}

// The second set holds what the first lacks; the weights of vertex 2 sum to 0.2, vertex 0 has none.
TEST(GltfSkin, AddsBothSetsAndNormalizesWeights) {
    EXPECT_THAT(
        bend([](GltfBuilder& gltf) {
            return Json{
                {"JOINTS_0",
                 gltf.accessor<std::uint8_t>("VEC4", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})},
                {"WEIGHTS_0", gltf.accessor<float>("VEC4", {0, 0, 0, 0, 0, 0, 0, 0, .1F, 0, 0, 0})},
                {"JOINTS_1",
                 gltf.accessor<std::uint8_t>("VEC4", {7, 7, 7, 7, 0, 1, 0, 0, 0, 0, 0, 1})},
                {"WEIGHTS_1",
                 gltf.accessor<float>("VEC4", {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, .1F})}};
        }),
        Pointwise(FloatNear(2e-6F), bent));
}

TEST(GltfSkin, AppliesInverseBindMatrices) {
    SkinnedTriangle gltf(Json::object());
    gltf.root["meshes"][0]["primitives"][0]["attributes"].update(two_joints(gltf));
    std::vector<float> matrices(32, 0);
    for (const std::size_t i : {0U, 5U, 10U, 15U, 16U, 21U, 26U, 31U}) matrices[i] = 1;
    matrices[12] = -10;  // undoes the first joint
    const int accessor = gltf.accessor<float>("VEC4", matrices, {{"type", "MAT4"}, {"count", 2}});
    gltf.root["skins"][0]["inverseBindMatrices"] = accessor;
    EXPECT_THAT(
        world_positions(load(gltf)),
        Pointwise(FloatNear(2e-6F), std::vector<float>{0, 0, 0, 10, 11, 0, 4.5F, 5.5F, 0}));
    gltf.root["accessors"][static_cast<std::size_t>(accessor)]["count"] = 1;
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: skin 0: has 2 joints, but 1 inverse bind matrices; export again");
}

// A joint that squeezes x tilts normals the other way.
TEST(GltfSkin, TurnsNormalsByTheInverseTranspose) {
    GltfBuilder gltf;
    const int normals = gltf.accessor<float>("VEC3", {0.6F, 0, 0.8F, 0.6F, 0, 0.8F, 0.6F, 0, 0.8F});
    gltf.object(
        {{"attributes",
          {{"POSITION", gltf.triangle_positions()},
           {"NORMAL", normals},
           {"JOINTS_0", gltf.accessor<std::uint8_t>("VEC4", std::vector<std::uint8_t>(12))},
           {"WEIGHTS_0", gltf.accessor<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0})}}}});
    gltf.root["nodes"][0]["skin"] = 0;
    gltf.node({{"scale", {-0.5, 1, 1}}});
    gltf.root["skins"] = {{{"joints", {1}}}};
    const float length = std::hypot(1.2F, 0.8F);
    EXPECT_THAT(
        std::vector(load(gltf).primitives.at(0).normals),
        Pointwise(
            FloatNear(1e-6F), std::vector<float>{
                                  -1.2F / length, 0, 0.8F / length, -1.2F / length, 0,
                                  0.8F / length, -1.2F / length, 0, 0.8F / length}));
}

// Positions would be known to 0.06 m only.
TEST(GltfSkin, KeepsPrecisionFarFromTheOrigin) {
    SkinnedTriangle gltf(Json::object());
    gltf.root["meshes"][0]["primitives"][0]["attributes"].update(two_joints(gltf));
    gltf.root["nodes"][1]["translation"] = {1e6, 0, 0};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.instances.at(0).to_world[12], 1e6);
    EXPECT_THAT(
        scene.primitives.at(0).positions,
        Pointwise(FloatNear(2e-6F), std::vector<float>{0, 0, 0, 0, 11, 0, -0.5F, 5.5F, 0}));
}

TEST(GltfSkin, BendsAfterMorphing) {
    SkinnedTriangle gltf(Json::object());
    Json& primitive = gltf.root["meshes"][0]["primitives"][0];
    const Json attributes = two_joints(gltf);
    const int shift = gltf.accessor<float>("VEC3", {0, 0, 1, 1, 0, 0, 0, 0, 0});
    primitive["attributes"].update(attributes);
    primitive["targets"] = {{{"POSITION", shift}}};
    gltf.root["nodes"][0]["weights"] = {2};
    EXPECT_THAT(
        world_positions(load(gltf)),
        Pointwise(FloatNear(2e-6F), std::vector<float>{10, 0, 2, 10, 13, 0, 9.5F, 5.5F, 0}));
}

TEST(GltfSkin, RejectsWhatIsBroken) {
    const auto error = [](const auto& breaks) {
        SkinnedTriangle gltf(Json::object());
        gltf.root["meshes"][0]["primitives"][0]["attributes"].update(two_joints(gltf));
        breaks(gltf, gltf.root["meshes"][0]["primitives"][0]["attributes"]);
        return load_error(gltf);
    };
    EXPECT_EQ(
        error([](auto&, Json& attributes) { attributes.erase("JOINTS_0"); }),
        "scene.gltf: mesh 0, primitive 0: its node has a skin, but it has no JOINTS_0; export "
        "again");
    EXPECT_THAT(
        error([](auto&, Json& attributes) { attributes.erase("WEIGHTS_0"); }),
        HasSubstr("has no WEIGHTS_0"));
    EXPECT_THAT(
        error([](auto& gltf, Json& attributes) {
            attributes["JOINTS_0"] =
                gltf.template accessor<std::uint8_t>("VEC4", {0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0});
        }),
        HasSubstr("primitive 0: refers to joint 2, but the skin has 2 of them"));
    EXPECT_THAT(
        error([](auto& gltf, Json& attributes) {
            attributes["WEIGHTS_0"] =
                gltf.template accessor<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, -1, 2, 0, 0});
        }),
        HasSubstr("holds weight -1, below 0"));
    EXPECT_THAT(
        error([](auto& gltf, Json& attributes) {
            attributes["WEIGHTS_0"] = gltf.template accessor<float>("VEC4", {1, 0, 0, 0});
        }),
        HasSubstr("WEIGHTS_0 has 1 rows, POSITION has 3"));
    EXPECT_THAT(
        error([](auto& gltf, Json&) { gltf.root["nodes"][0]["skin"] = 5; }),
        HasSubstr("node 0: refers to skin 5"));
    EXPECT_THAT(
        error([](auto& gltf, Json&) {
            gltf.root["skins"][0]["joints"] = {1, 8};
        }),
        HasSubstr("skin 0: refers to node 8"));
    EXPECT_THAT(
        error([](auto& gltf, Json&) { gltf.root["scenes"][0]["nodes"] = {0}; }),
        HasSubstr("skin 0: its joint node 1 is not in the scene of its mesh"));
}

}  // namespace
}  // namespace wavepath
