// Tests src/gltf/gltf_light.cpp.
#include "gltf/gltf_nodes.h"
#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Pointwise;

Scene with_light(const Json& light, Json node = Json::object(), const Json& index = 0) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf.root["extensionsRequired"] = {"KHR_lights_punctual"};
    gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {light};
    node["extensions"]["KHR_lights_punctual"]["light"] = index;
    gltf.node(node);
    return load(gltf);
}

TEST(GltfLight, HasDefaults) {
    const Scene scene = with_light({{"type", "point"}}, {{"name", "bulb"}});
    ASSERT_EQ(scene.lights.size(), 1U);
    const PunctualLight& light = scene.lights[0];
    EXPECT_EQ(light.name, "bulb");
    EXPECT_EQ(light.kind, LightKind::point);
    EXPECT_EQ(light.intensity, (Rgb{1, 1, 1}));
    EXPECT_EQ(light.range, 0);
    EXPECT_TRUE(scene.ignored.empty());
}

TEST(GltfLight, TakesPlaceAndDirectionFromItsNodeAndNothingElse) {
    const double half = std::sqrt(0.5);  // a quarter turn about +Y takes -z to -x
    const PunctualLight light =
        with_light(
            {{"type", "spot"},
             {"name", "lamp"},
             {"color", {1, 0.5, 0}},
             {"intensity", 40},
             {"range", 6},
             {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
            {{"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}, {"scale", {5, 5, 5}}})
            .lights.at(0);
    EXPECT_EQ(light.name, "lamp");
    EXPECT_EQ(light.kind, LightKind::spot);
    EXPECT_EQ(light.intensity, (Rgb{40, 20, 0}));
    EXPECT_EQ(light.position, (Vec3d{1, 2, 3}));
    EXPECT_THAT(light.direction, Pointwise(DoubleNear(1e-15), Vec3d{-1, 0, 0}));
    EXPECT_EQ(light.range, 6);
    EXPECT_EQ(light.inner_cone, 0.1);
    EXPECT_EQ(light.outer_cone, 0.2);
}

TEST(GltfLight, ReadsDirectionalLights) {
    const PunctualLight light =
        with_light({{"type", "directional"}, {"intensity", 3}}).lights.at(0);
    EXPECT_EQ(light.kind, LightKind::directional);
    EXPECT_EQ(light.intensity, (Rgb{3, 3, 3}));
    EXPECT_EQ(light.direction, (Vec3d{0, 0, -1}));
}

TEST(GltfLight, HasTheSpecifiedConeWhereNoneIsGiven) {
    const PunctualLight light =
        with_light({{"type", "spot"}, {"spot", Json::object()}}).lights.at(0);
    EXPECT_EQ(light.inner_cone, 0);
    EXPECT_NEAR(light.outer_cone, std::numbers::pi / 4, 1e-9);
}

TEST(GltfLight, RejectsWhatIsNoLight) {
    const auto error = [](const Json& light, const Json& node = Json::object(),
                          const Json& index = 0) {
        return error_of([&] { with_light(light, node, index); });
    };
    const auto spot = [](double inner, double outer) {
        return Json{
            {"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}};
    };
    EXPECT_EQ(
        error({{"type", "moon"}, {"name", "m"}}),
        "scene.gltf: light 0 \"m\": type \"moon\" is unknown; use point, spot or directional");
    EXPECT_THAT(error(spot(0.5, 0.4)), HasSubstr("light 0: cone angles 0.5 and 0.4 rad are not"));
    EXPECT_THAT(error(spot(0.5, 1.6)), HasSubstr("cone angles"));
    EXPECT_THAT(error(spot(-0.1, 1)), HasSubstr("cone angles"));
    EXPECT_EQ(error(spot(0.5, 0.5)), "") << "a hard edge";
    EXPECT_THAT(
        error({{"type", "point"}, {"intensity", -1}}),
        HasSubstr("light 0: color 1 times intensity -1 is no intensity"));
    EXPECT_THAT(error({{"type", "point"}, {"intensity", 1e39}}), HasSubstr("is no intensity"));
    EXPECT_THAT(error({{"type", "point"}, {"color", {1, 1}}}), HasSubstr("color has 2 numbers"));
    EXPECT_THAT(error({{"type", "point"}, {"range", -1}}), HasSubstr("range is -1, not positive"));
    EXPECT_THAT(
        error({{"type", "point"}}, Json::object(), 1), HasSubstr("node 1: refers to light 1"));
    EXPECT_THAT(
        error({{"type", "point"}}, Json::object(), "a"),
        HasSubstr("node 1: extensions.KHR_lights_punctual.light is \"a\", not an integer"));
    EXPECT_THAT(
        error({{"type", "directional"}}, {{"scale", {1, 1, 0}}}),
        HasSubstr("node 1: its scale leaves the light no direction"));
    EXPECT_EQ(error({{"type", "point"}}, {{"scale", {0, 0, 0}}}), "") << "it needs no direction";
}

}  // namespace
}  // namespace wavepath
