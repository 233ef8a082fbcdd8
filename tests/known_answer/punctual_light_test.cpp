// KHR_lights_punctual on a Lambert floor: one light, one bounce, nothing random but the place in a
// tiny pixel.
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double albedo = 0.5;

// The radiance of the floor z = 0 at the origin.
testing::AssertionResult floor_radiance(
    const std::vector<PunctualLight>& lights, double truth, const char* method) {
    Scene scene = scene_named("floor");
    add_square(scene, lambert({0.5F, 0.25F, 0}), {0, 0, 0}, {0, 0, 1}, 2);
    scene.lights = lights;
    const Camera camera = close_up({0, 0, 0}, {0, 0, 1}, 0.01, 1e-5);
    const RenderResult result =
        render_scene(scene, square_settings(method, camera, 16, lights.size() > 1 ? 1024 : 2));
    const Estimate red = shared_mean(result, "R");
    const Estimate green = shared_mean(result, "G");
    // the footprint's first-order term shrinks with the mean over the pixel: 1e-5 of the distance
    if (const auto r = has_mean(red, truth, {.truth_error = 2e-5}); !r)
        return testing::AssertionFailure() << "R: " << r.message();
    if (const auto g = has_mean(green, truth / 2, {.truth_error = 2e-5}); !g)
        return testing::AssertionFailure() << "G: " << g.message();
    return testing::AssertionSuccess();
}

PunctualLight point_light() {
    PunctualLight light;
    light.position = {0.3, 0.4, 1.2};  // 1.3 away
    light.intensity = grey(2);
    return light;
}

constexpr double point_irradiance = 2 * (1.2 / 1.3) / (1.3 * 1.3);

TEST(PunctualLight, PointFollowsTheInverseSquare) {
    for (const char* method : {"direct", "mis"})
        EXPECT_TRUE(floor_radiance({point_light()}, albedo / pi * point_irradiance, method));
}

TEST(PunctualLight, RangeEndsIt) {
    PunctualLight light = point_light();
    light.range = 2;
    const double window = 1 - std::pow(1.3 / 2, 4);
    EXPECT_TRUE(floor_radiance({light}, albedo / pi * point_irradiance * window, "mis"));
    light.range = 1.29;
    EXPECT_TRUE(floor_radiance({light, point_light()}, albedo / pi * point_irradiance, "mis"));
}

TEST(PunctualLight, SpotFallsOffBetweenItsCones) {
    PunctualLight light = point_light();
    light.kind = LightKind::spot;
    light.direction = {0, 0, -1};
    const double cosine = 1.2 / 1.3;  // of the floor's direction as the spot sees it
    light.inner_cone = 0.1;
    light.outer_cone = 0.6;
    const double t = (cosine - std::cos(0.6)) / (std::cos(0.1) - std::cos(0.6));
    EXPECT_TRUE(floor_radiance({light}, albedo / pi * point_irradiance * t * t, "direct"));
    light.inner_cone = 0.5;
    EXPECT_TRUE(floor_radiance({light}, albedo / pi * point_irradiance, "direct"));
    light.outer_cone = 0.3;
    light.inner_cone = 0;
    EXPECT_TRUE(floor_radiance({light, point_light()}, albedo / pi * point_irradiance, "direct"));
}

TEST(PunctualLight, DirectionalHasNoDistance) {
    PunctualLight light;
    light.kind = LightKind::directional;
    light.intensity = grey(3);
    light.direction = {0.6, 0, -0.8};
    EXPECT_TRUE(floor_radiance({light}, albedo / pi * 3 * 0.8, "mis"));
}

TEST(PunctualLight, SeveralAddUp) {
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = grey(1);
    PunctualLight high = point_light();
    high.position = {0, 0, 2};
    high.intensity = grey(1);
    const double truth = albedo / pi * (1 + 0.25 + point_irradiance);
    EXPECT_TRUE(floor_radiance({sun, high, point_light()}, truth, "mis"));
    EXPECT_TRUE(floor_radiance({sun, high, point_light()}, truth, "direct"));
}

}  // namespace
}  // namespace wavepath
