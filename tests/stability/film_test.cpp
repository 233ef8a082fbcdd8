// Long sums, non-finite samples, paths without an end.
#include "support/rendering.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavepath {
namespace {

// Black walls that emit .1: every sample is float(.1). A plain sum in single precision is off by 1
// % after 10^6.
void expect_constant(uint64_t samples) {
    Scene scene = scene_named("constant");
    add_box(scene, lambert(grey(0), grey(0.1F)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    const RenderResult result = render_scene(
        scene, square_settings("path", perspective({0, 0, 0}, {1, 0.2, 0.3}, 1), 4, samples));
    EXPECT_EQ(result.samples, samples);
    for (const float pixel : result.film.image.channels.at("R")) EXPECT_NEAR(pixel / 0.1F, 1, 1e-6);
    for (const float variance : result.film.image.channels.at("variance.R"))
        EXPECT_LT(variance, 1e-14);
}

TEST(Film, StaysRightAtAMillionSamples) {
    expect_constant(1000000);
}

TEST(Film, StaysRightAtTenMillionSamples) {
    expect_constant(10000000);
}

// The loader refuses such files; a scene in memory can hold what a bug would make.
TEST(Film, CountsNonFiniteSamples) {
    Scene scene = scene_named("infinite lamp");
    add_box(scene, lambert(grey(0), grey(1)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    // covers pixel (5, 2) of 8 x 8 and no other
    add_square(
        scene, lambert(grey(0), {std::numeric_limits<float>::infinity(), 0, 0}), {0.375, 0.375, 0},
        {0, 0, 1}, 0.24999);
    const Camera camera = orthographic({0, 0, 0.5}, {0, 0, 0}, 2);
    const RenderResult result =
        render(test_device(), scene, square_settings("path", camera, 8, 40));
    // the square covers .9999 of the pixel: every sample of it, but for one in 10^4
    EXPECT_EQ(result.film.nonfinite.samples, 40U);
    EXPECT_EQ(result.film.nonfinite.x, 5U);
    EXPECT_EQ(result.film.nonfinite.y, 2U);
    EXPECT_EQ(result.film.nonfinite.sample, 0U);
    const std::vector<float>& red = result.film.image.channels.at("R");
    EXPECT_EQ(std::ranges::count_if(red, [](float x) { return !std::isfinite(x); }), 1);
    EXPECT_FALSE(std::isfinite(red[2 * 8 + 5]));
    EXPECT_EQ(red[0], 1);
    EXPECT_TRUE(std::isfinite(result.film.relative_error));
}

TEST(Film, CountsThroughputsThatAreNotNumbers) {
    Scene scene = scene_named("broken paint");
    add_square(
        scene, lambert(grey(std::numeric_limits<float>::quiet_NaN())), {0, 0, 0}, {0, 0, 1}, 1);
    scene.environment = constant_environment(1);
    const RenderResult result = render(
        test_device(), scene,
        square_settings("bsdf", orthographic({0, 0, 1}, {0, 0, 0}, 0.5), 4, 5));
    EXPECT_EQ(result.film.nonfinite.samples, 4U * 4 * 5);
    EXPECT_EQ(result.film.nonfinite.x, 0U);
    EXPECT_EQ(result.film.nonfinite.y, 0U);
}

Scene trap() {
    Scene scene = scene_named("trap");
    add_box(scene, lambert(grey(1)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    scene.environment = constant_environment(1);
    return scene;
}

TEST(Interruption, DoesNotWaitForAPathThatNeverEnds) {
    RenderSettings settings = square_settings("bsdf", perspective({0, 0, 0}, {1, 0, 0}, 1), 1, 1);
    settings.termination = {TerminationKind::zero, 0, 1};
    const RenderResult result = render(test_device(), trap(), settings, {}, [] { return true; });
    EXPECT_TRUE(result.interrupted);
    EXPECT_EQ(result.samples, 0U);
    EXPECT_LE(result.iterations, 1001U);
}

TEST(Interruption, LeavesWholePasses) {
    Scene scene = scene_named("box");
    add_box(scene, lambert(grey(0.5F), grey(1)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    RenderSettings settings =
        square_settings("path", perspective({0, 0, 0}, {1, 0, 0}, 1), 8, 4096);
    settings.pool = 64;
    const RenderResult stopped = render(test_device(), scene, settings, {}, [] { return true; });
    EXPECT_TRUE(stopped.interrupted);
    EXPECT_LT(stopped.samples, settings.samples);
    ASSERT_GT(stopped.samples, 0U);
    settings.samples = stopped.samples;
    const RenderResult whole = render(test_device(), scene, settings);
    EXPECT_FALSE(whole.interrupted);
    EXPECT_EQ(whole.film.image.channels.at("R"), stopped.film.image.channels.at("R"));
}

}  // namespace
}  // namespace wavepath
