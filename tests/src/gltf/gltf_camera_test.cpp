// Tests src/gltf/gltf_camera.cpp.
#include "gltf/gltf_nodes.h"
#include "scene/camera.h"
#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <cmath>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Pointwise;

const Json perspective = {
    {"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}};

Scene with_camera(const Json& camera, Json node = Json::object()) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.add("cameras", camera);
    node["camera"] = 0;
    gltf.node(node);
    return load(gltf);
}

// Cameras of these names, on no node yet.
GltfBuilder with_cameras(const std::vector<std::string>& names) {
    GltfBuilder gltf;
    gltf.triangle();
    for (const std::string& name : names) {
        Json camera = perspective;
        camera["name"] = name;
        gltf.add("cameras", camera);
    }
    return gltf;
}

TEST(GltfCamera, ReadsPerspective) {
    Json source = perspective;
    source["name"] = "front";
    source["perspective"]["aspectRatio"] = 1.5;
    const Camera camera = with_camera(source, {{"translation", {1, 2, 3}}}).cameras.at(0);
    EXPECT_EQ(camera.name, "front");
    EXPECT_FALSE(camera.orthographic);
    EXPECT_EQ(camera.y_fov, 0.5);
    EXPECT_EQ(camera.aspect_ratio, 1.5);
    EXPECT_EQ(camera.to_world, (Matrix4{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}));
    EXPECT_EQ(with_camera(perspective).cameras.at(0).aspect_ratio, 0) << "left to the image";
}

TEST(GltfCamera, ReadsOrthographic) {
    const Camera camera =
        with_camera(
            {{"type", "orthographic"},
             {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 10}}}},
            {{"name", "plan"}})
            .cameras.at(0);
    EXPECT_EQ(camera.name, "plan") << "the node's name stands in";
    EXPECT_TRUE(camera.orthographic);
    EXPECT_EQ(camera.x_mag, 3);
    EXPECT_EQ(camera.y_mag, 2);
    EXPECT_EQ(camera.aspect_ratio, 1.5);
}

TEST(GltfCamera, IgnoresTheScaleOfItsNode) {
    const double half = std::sqrt(0.5);
    const auto frame = [&](const Json& scale) {
        return with_camera(perspective, {{"rotation", {0, half, 0, half}}, {"scale", scale}})
            .cameras.at(0)
            .to_world;
    };
    const Matrix4 expected{0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1};
    EXPECT_THAT(frame({2, 3, 4}), Pointwise(DoubleNear(1e-15), expected));
    EXPECT_THAT(frame({-1, 1, 1}), Pointwise(DoubleNear(1e-15), expected)) << "a mirrored node";
}

TEST(GltfCamera, KeepsTheOrderOfNodes) {
    GltfBuilder gltf = with_cameras({"a", "b"});
    gltf.node({{"camera", 1}});
    gltf.node({{"camera", 0}});
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.cameras[0].name, "b");
    EXPECT_EQ(scene.cameras[1].name, "a");
}

// Blender's users see the name of the object, which is the node's.
TEST(GltfCamera, IsFoundByTheNameOfItsNode) {
    GltfBuilder gltf = with_cameras({"Camera", "Camera.001"});
    gltf.node({{"camera", 0}, {"name", "Camera.001"}});
    gltf.node({{"camera", 1}, {"name", "close"}});
    const Scene scene = load(gltf);
    EXPECT_EQ(choose_camera(scene, "close").name, "Camera.001");
    EXPECT_EQ(choose_camera(scene, "Camera.001").node, "close") << "names of cameras come first";
    EXPECT_THAT(
        error_of([&] { choose_camera(scene, "far"); }),
        HasSubstr("Camera (on \"Camera.001\"), Camera.001 (on \"close\")"));
}

TEST(GltfCamera, RejectsWhatSeesNothing) {
    const auto error = [](const Json& camera, const Json& node = Json::object()) {
        return error_of([&] { with_camera(camera, node); });
    };
    Json wide = perspective, flat = perspective, negative = perspective;
    wide["perspective"]["yfov"] = 3.2;
    flat["perspective"]["yfov"] = 0;
    negative["perspective"]["aspectRatio"] = -1;
    EXPECT_EQ(
        error(wide), "scene.gltf: camera 0: yfov is 3.2 rad, not between 0 and pi; repair it");
    EXPECT_THAT(error(flat), HasSubstr("yfov is 0 rad"));
    EXPECT_THAT(error(negative), HasSubstr("aspectRatio is -1, not positive"));
    EXPECT_THAT(
        error(
            {{"type", "orthographic"},
             {"orthographic", {{"xmag", 0}, {"ymag", 2}, {"znear", 0}, {"zfar", 1}}}}),
        HasSubstr("xmag 0 and ymag 2 must be positive"));
    EXPECT_THAT(error({{"type", "fisheye"}}), HasSubstr("Invalid camera type: \"fisheye\""));
    EXPECT_THAT(
        error(perspective, {{"scale", {0, 0, 0}}}),
        HasSubstr("node 1: its scale leaves the camera no direction"));
}

}  // namespace
}  // namespace wavepath
