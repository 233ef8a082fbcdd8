#include "gltf/gltf_instancing.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <cmath>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;

// A triangle at (10, 0, 0), twice as large, with these instances.
void add_instances(GltfBuilder& gltf, const Json& attributes) {
    gltf.triangle();
    gltf.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    gltf.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    Json& node = gltf.root["nodes"][0];
    node["translation"] = {10, 0, 0};
    node["scale"] = {2, 2, 2};
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
}

TEST(GltfInstancing, PlacesInstancesInTheSpaceOfTheNode) {
    const float half = std::sqrt(0.5F);
    GltfBuilder gltf;
    const int translation = gltf.accessor<float>("VEC3", {1, 2, 3, 4, 5, 6});
    const int rotation = gltf.accessor<float>("VEC4", {0, 0, 0, 1, 0, 0, half, half});
    const int scale = gltf.accessor<float>("VEC3", {1, 1, 1, 1, -3, 5});
    add_instances(
        gltf,
        {{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}, {"_ID", 99}});
    const Scene scene = load(gltf);
    EXPECT_THAT(scene.ignored, IsEmpty());
    EXPECT_EQ(scene.primitives.size(), 1U);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.triangle_count(), 2U);
    EXPECT_THAT(
        scene.instances[0].to_world,
        Pointwise(DoubleNear(0), Matrix4{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 12, 4, 6, 1}));
    EXPECT_THAT(
        scene.instances[1].to_world,
        Pointwise(DoubleNear(1e-6), Matrix4{0, 2, 0, 0, 6, 0, 0, 0, 0, 0, 10, 0, 18, 10, 12, 1}));
}

TEST(GltfInstancing, TakesRotationsAsNormalizedIntegers) {
    const auto x_axis = [](auto unit) {
        GltfBuilder gltf;  // half a turn about +Z, and none
        const int rotation = gltf.accessor<decltype(unit)>(
            "VEC4", {0, 0, unit, 0, 0, 0, 0, unit}, {{"normalized", true}});
        add_instances(gltf, {{"ROTATION", rotation}});
        const Scene scene = load(gltf);
        return std::pair(scene.instances.at(0).to_world[0], scene.instances.at(1).to_world[0]);
    };
    EXPECT_EQ(x_axis(std::int8_t{127}), std::pair(-2.0, 2.0));
    EXPECT_EQ(x_axis(std::int16_t{32767}), std::pair(-2.0, 2.0));
}

TEST(GltfInstancing, LeavesOutInstancesScaledToNothing) {
    GltfBuilder gltf;
    add_instances(gltf, {{"SCALE", gltf.accessor<float>("VEC3", {1, 1, 1, 0, 0, 0})}});
    EXPECT_EQ(load(gltf).instances.size(), 1U);
}

TEST(GltfInstancing, RejectsWhatIsBroken) {
    const auto error = [](const auto& attributes) {
        GltfBuilder gltf;
        add_instances(gltf, attributes(gltf));
        return load_error(gltf);
    };
    EXPECT_EQ(
        error([](GltfBuilder& gltf) {
            return Json{
                {"TRANSLATION", gltf.accessor<float>("VEC3", {0, 0, 0, 1, 1, 1})},
                {"SCALE", gltf.accessor<float>("VEC3", {1, 1, 1})}};
        }),
        "scene.gltf: node 0, instances' SCALE: has 1 rows, another attribute 2; repair the "
        "instances or export again");
    EXPECT_EQ(
        error([](GltfBuilder& gltf) {
            return Json{{"ROTATION", gltf.accessor<float>("VEC4", {0, 0, 0, 1, 0, 0, 0, 0})}};
        }),
        "scene.gltf: node 0: instance 1 has the zero quaternion; export again");
    EXPECT_THAT(
        error([](GltfBuilder&) { return Json::object(); }),
        HasSubstr("EXT_mesh_gpu_instancing has no attributes"));
    EXPECT_THAT(
        error([](GltfBuilder&) {
            return Json{{"SCALE", "three"}};
        }),
        HasSubstr("node 0: extensions.EXT_mesh_gpu_instancing.attributes.SCALE is \"three\", not "
                  "an integer"));
    EXPECT_THAT(
        error([](GltfBuilder&) {
            return Json{{"SCALE", 7}};
        }),
        HasSubstr("instances' SCALE: refers to accessor 7"));
}

// 2^18 instances of 2^18 triangles from a file of a few hundred bytes.
TEST(GltfInstancing, RefusesWhatDoesNotFitMemory) {
    constexpr int many = 1 << 18;
    GltfBuilder gltf;
    const auto zeros = [&](int count) {
        return gltf.add("accessors", {{"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
    };
    add_instances(gltf, {{"TRANSLATION", zeros(many)}});
    gltf.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = zeros(3 * many);
    EXPECT_THAT(
        load_error(gltf),
        testing::AllOf(
            HasSubstr("node 0: brings the scene to 68719476736 triangles, which take"),
            HasSubstr("place fewer instances or use a machine with more memory")));
}

}  // namespace
}  // namespace wavepath
