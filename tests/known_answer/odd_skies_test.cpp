// Maps of few texels from files: as bright as the bilinear lookup makes them, on a white plate, on
// a ball of metal, and behind a lamp.
#include "gltf/gltf_loader.h"
#include "scene/environment_map.h"
#include "support/case_files.h"
#include "support/rendering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double pi = std::numbers::pi;

class OddSkies : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = case_folder("odd-skies");
        if (folder_.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    }

    Scene under(const std::string& map, const std::string& what) const {
        Scene scene = load_gltf(folder_ / (what + ".gltf"));
        scene.environment = load_environment_map(folder_ / (map + ".hdr"));
        return scene;
    }

    // Lit once: the lamp's black face mirrors some of what it is sent.
    Estimate plate(const std::string& map, double bias, const std::string& what = "plate") const {
        RenderSettings settings =
            square_settings("mis", close_up({0, 0, 0}, {0, 1, 0}, 0.1, 0.01), 16, 256);
        settings.termination = parse_termination("depth:1");
        return shared_mean(render_for({.bias = bias}, under(map, what), settings));
    }

    // From above: what the sky holds in one direction and in the opposite one counts alike.
    RenderResult ball(const Scene& scene, double bias, const char* method = "mis") const {
        const Camera camera = orthographic({0, 3, 0}, {0, 0, 0}, 1.4);
        return render_for({.bias = bias / 1.5}, scene, square_settings(method, camera, 16, 256));
    }

  private:
    std::filesystem::path folder_;
};

constexpr const char* maps_of_ones[]{"ones_1x1", "ones_1x2", "ones_1x9", "ones_2x1",
                                     "ones_3x1", "ones_5x3", "ones_7x1"};

// E / pi of a plate that faces up, of a map of this many rows whose topmost is 1 and whose others
// are 0: 1 down to the row's middle, then falling to 0 at the middle of the next.
double top_row(unsigned rows) {
    const double from = 0.5 * pi / rows;
    const double to = std::min(1.5 * pi / rows, 0.5 * pi);
    const auto flat = [](double theta) { return -0.5 * std::cos(2 * theta); };
    const auto slope = [](double theta) {
        return -0.5 * theta * std::cos(2 * theta) + 0.25 * std::sin(2 * theta);
    };
    return flat(from) - flat(0) + 1.5 * (flat(to) - flat(from)) -
           rows / pi * (slope(to) - slope(from));
}

TEST_F(OddSkies, OfOnesAreOne) {
    for (const char* map : maps_of_ones) {
        SCOPED_TRACE(map);
        EXPECT_TRUE(has_mean(plate(map, 0.005), 1, {.truth_error = 1e-5}));
        // the lamp's radiance is that of the sky which it hides
        EXPECT_TRUE(has_mean(plate(map, 0.005, "plate_lamp"), 1, {.truth_error = 1e-5}));
    }
}

// A map of one texel taken for a sky without a size would be black, or have no direction to
// choose.
TEST_F(OddSkies, OfOnesLightABallAsAConstantDoes) {
    Scene scene = under("ones_1x1", "ball");
    scene.environment = constant_environment(1);
    const Estimate truth = image_mean(ball(scene, 0.01));
    for (const char* map : maps_of_ones)
        EXPECT_TRUE(agree(image_mean(ball(under(map, "ball"), 0.01)), truth, {.bias = 0.01}))
            << map;
}

// .90916, .09085, .5, 23.558 and 2.6075 by quadrature.
TEST_F(OddSkies, AreAsBrightAsTheirTexels) {
    const std::pair<const char*, double> truths[]{
        {"north_1x2", top_row(2)},
        {"south_1x2", 1 - top_row(2)},
        {"half_2x1", 0.5},
        {"sun_3x3", 100. / 3 * top_row(3)},
        {"pole_1x64", 1000 * top_row(64)},
        {"faint_8x4", 162 * std::exp2(-107)},  // the codes of 1e-30 in its file
    };
    EXPECT_NEAR(top_row(2), 0.75 + 0.5 / pi, 1e-12);
    for (const auto& [map, truth] : truths)
        EXPECT_TRUE(has_mean(plate(map, 0.005), truth, {.truth_error = 1e-5})) << map;
}

// The halves of a sky make it up, on a ball too.
TEST_F(OddSkies, LightABallByHalves) {
    const auto seen = [&](const char* map, double bias) {
        return image_mean(ball(under(map, "ball"), bias));
    };
    const Estimate whole = seen("ones_1x1", 0.01);
    const Estimate north = seen("north_1x2", 0.01);
    const Estimate south = seen("south_1x2", 0.05);
    const Estimate sum{
        north.mean + south.mean, std::hypot(north.error, south.error),
        std::min(north.degrees, south.degrees)};
    EXPECT_TRUE(agree(sum, whole, {.bias = 0.015}));
    const Estimate half = seen("half_2x1", 0.01);
    EXPECT_TRUE(agree({2 * half.mean, 2 * half.error, half.degrees}, whole, {.bias = 0.015}));
}

// Rarely does a direction of the lobe meet the pole, which 1.4 degrees wide has all the light.
TEST_F(OddSkies, OfOneTexelLightABallAlikeByEveryMethod) {
    for (const auto& [map, method] : {std::pair{"sun_3x3", "bsdf"}, {"pole_1x64", "direct"}}) {
        const Scene scene = under(map, "ball");
        EXPECT_TRUE(agree(
            image_mean(ball(scene, 0.03)), image_mean(ball(scene, 0.03, method)), {.bias = 0.04}))
            << map;
    }
}

// Nothing comes from them, and a lamp beside them is chosen always: a square of 100 m, 1 m above.
TEST_F(OddSkies, ThatAreBlackTakeNothingFromALamp) {
    const double x = 50 / std::sqrt(2501.);
    const double truth = 4 / pi * x * std::atan(x);
    for (const char* map : {"black_1x1", "black_8x4", "faint_8x4"}) {
        SCOPED_TRACE(map);
        EXPECT_TRUE(has_mean(plate(map, 0.005, "plate_lamp"), truth, {.truth_error = 1e-5}));
    }
    for (const char* map : {"black_1x1", "black_8x4"})
        for (const char* what : {"plate", "ball"})
            EXPECT_EQ(image_mean(ball(under(map, what), 1)).mean, 0) << map << ", " << what;
}

}  // namespace
}  // namespace wavepath
