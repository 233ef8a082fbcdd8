// Spots of half a degree to 45, with soft and hard edges, as their files say: what a spot lights in
// its middle does not depend on how wide it is.
#include "gltf/gltf_loader.h"
#include "support/case_files.h"
#include "support/rendering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double intensity = 100;  // [cd], 1 m above a white floor

// saturate((cos - cos outer) / (cos inner - cos outer))^2 [KHR_lights_punctual], by half angles.
double falloff(double angle, double inner, double outer) {
    const auto versine = [](double x) { return std::pow(std::sin(0.5 * x), 2); };
    if (inner >= outer) return angle < outer ? 1 : 0;
    const double t =
        std::clamp((versine(outer) - versine(angle)) / (versine(outer) - versine(inner)), 0., 1.);
    return t * t;
}

// Of the floor where it is seen at this angle from the spot's axis. It varies over the two
// micrometres that are looked at.
Estimate radiance_at(const Scene& scene, double angle) {
    const Camera camera = close_up({std::tan(angle), 0, 0}, {0, 1, 0}, 0.5, 2e-6);
    return shared_mean(render_scene(scene, square_settings("mis", camera, 8, 1)));
}

class NarrowSpot : public testing::TestWithParam<const char*> {};

// The sample code of the extension divides by at least 1e-3, which left .0462 on the axis of a cone
// of half a degree, 28.8 of one of 2.5, and .2 of the radiance near the hard edge of one of 5.
TEST_P(NarrowSpot, OfAFileLightsItsMiddleInFull) {
    const auto folder = case_folder("narrow-spot");
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    const std::string kind = GetParam();
    for (const char* width : {"0.5", "1", "2", "2.5", "5", "10", "45"}) {
        const std::string name = fmt::format("spot_{}_{}.gltf", width, kind);
        SCOPED_TRACE(name);
        const Scene scene = load_gltf(folder / name);
        ASSERT_EQ(scene.lights.size(), 1U);
        const double outer = std::stod(width) * degree;
        const double inner = kind == "soft" ? 0 : kind == "hard" ? 0.999 * outer : outer;
        for (const double share : {0., 0.5, 0.94}) {
            const double angle = share * outer;
            const double truth = intensity / std::numbers::pi * falloff(angle, inner, outer) *
                                 std::pow(std::cos(angle), 3);
            EXPECT_TRUE(has_mean(radiance_at(scene, angle), truth, {.truth_error = 1e-5}))
                << share << " of the cone";
        }
        if (outer < 40 * degree) {  // else the floor ends there
            EXPECT_EQ(radiance_at(scene, 1.05 * outer).mean, 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Edges,
    NarrowSpot,
    testing::Values("soft", "hard", "equal"),
    [](const testing::TestParamInfo<const char*>& edge) { return std::string(edge.param); });

}  // namespace
}  // namespace wavepath
