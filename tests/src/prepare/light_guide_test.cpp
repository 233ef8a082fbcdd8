#include "prepare/light_guide.h"

#include "support/media.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace wavepath {
namespace {

std::optional<LightGuide> guide_of(const Scene& scene) {
    const NormalisedScene geometry = normalise(scene);
    const LightTables lights = build_light_tables(scene, geometry, LightChoice::power, false);
    return guide_to_lights(scene, geometry, lights, build_media_tables(scene, geometry));
}

// A ceiling at height 1 over a floor at -1, both two metres wide.
Scene ceiling_and_floor() {
    Scene scene;
    scene.name = "ceiling and floor";
    add_square(scene, lambert(grey(0.5F)), {0, -1, 0}, {0, 1, 0}, 2);
    add_square(scene, lambert(grey(0.5F)), {0, 1, 0}, {0, -1, 0}, 2);
    return scene;
}

TEST(LightGuide, FindsTheCeilingOverALampThatShinesUp) {
    Scene scene = ceiling_and_floor();
    add_square(scene, lambert(grey(0), grey(1)), {0.2, 0.9, 0}, {0, 1, 0}, 0.2);
    const auto guide = guide_of(scene);
    ASSERT_TRUE(guide.has_value());
    // normalised: metres / 2; the lamp's half diagonal is 0.1 sqrt 2 metres
    EXPECT_NEAR(guide->centre[0], 0.1, 1e-6);
    EXPECT_NEAR(guide->centre[1], 0.45, 1e-6);
    EXPECT_NEAR(guide->radius, 1.4 * 0.1 * std::sqrt(2.0) / 2, 1e-6);
}

TEST(LightGuide, LeavesACeilingAloneThatALampTurnsItsBackTo) {
    Scene scene = ceiling_and_floor();
    add_square(scene, lambert(grey(0), grey(1)), {0, 0.9, 0}, {0, -1, 0}, 0.2);
    EXPECT_FALSE(guide_of(scene).has_value());
}

TEST(LightGuide, FindsTheCeilingOverATwoSidedLamp) {
    Scene scene = ceiling_and_floor();
    add_square(scene, lambert(grey(0), grey(1), true), {0, 0.9, 0}, {0, -1, 0}, 0.2);
    EXPECT_TRUE(guide_of(scene).has_value());
}

TEST(LightGuide, NeedsALampThatIsCloseToSomething) {
    Scene scene = ceiling_and_floor();
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 0}, {0, 1, 0}, 0.2);
    EXPECT_FALSE(guide_of(scene).has_value());
}

TEST(LightGuide, SeesNoSurfaceInABoundary) {
    Scene scene = ceiling_and_floor();
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 0}, {0, 1, 0}, 0.2);
    add_box(scene, boundary_of({}), {-1, 0.05, -1}, {1, 0.5, 1}, Facing::outward);
    EXPECT_FALSE(guide_of(scene).has_value());
}

TEST(LightGuide, NeedsLampsThatAreTogether) {
    Scene scene = ceiling_and_floor();
    add_square(scene, lambert(grey(0), grey(1)), {-0.8, 0.9, 0}, {0, 1, 0}, 0.2);
    add_square(scene, lambert(grey(0), grey(1)), {0.8, 0.9, 0}, {0, 1, 0}, 0.2);
    EXPECT_FALSE(guide_of(scene).has_value());
}

TEST(LightGuide, NeedsMostOfTheLightToComeFromThem) {
    Scene scene = ceiling_and_floor();
    add_square(scene, lambert(grey(0), grey(1)), {0, 0.9, 0}, {0, 1, 0}, 0.2);
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = grey(10);
    scene.lights.push_back(sun);
    EXPECT_FALSE(guide_of(scene).has_value());
}

// A lamp of half diagonal 0.14 in fog: 1 / sigma_t against 0.2 metres.
TEST(LightGuide, NeedsFogThatLightCrosses) {
    for (const auto& [sigma_t, albedo, found] :
         {std::tuple{1.0, 0.9, true}, {4.0, 0.9, true}, {6.0, 0.9, false}, {1.0, 0.0, false}}) {
        Scene scene = ceiling_and_floor();
        add_square(scene, lambert(grey(0), grey(1)), {0, 0, 0}, {0, 1, 0}, 0.2);
        add_box(
            scene, boundary_of(medium_of(sigma_t, albedo)), {-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1},
            Facing::outward);
        EXPECT_EQ(guide_of(scene).has_value(), found) << sigma_t << ", albedo " << albedo;
    }
}

}  // namespace
}  // namespace wavepath
