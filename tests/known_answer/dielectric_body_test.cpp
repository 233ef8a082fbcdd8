// Bodies of glass: in one another, around what emits, the camera or nothing, and with microfacets.
#include "support/media.h"
#include "support/rendering.h"

#include <set>

namespace wavepath {
namespace {

// A block of glass on white ground under a white sky shows 1, whatever stands in it or reaches into
// it: boundaries around nothing, and bodies that only scatter, index-matched or not.
TEST(Dielectric, BodiesInOneAnotherKeepTheFurnace) {
    const struct {
        const char* what;
        Material other;
        Vec3d low, high;
    } cases[] = {
        {"nothing, within", boundary_of({}), {-0.5, -0.5, 0.2}, {0.5, 0.5, 0.6}},
        {"nothing, through all faces", boundary_of({}), {-1.5, -1.5, 0.2}, {1.5, 1.5, 0.6}},
        {"nothing, through a corner", boundary_of({}), {-0.5, -0.5, 0.5}, {1.5, 1.5, 1.5}},
        {"fog around", boundary_of(medium_of(0.3, 1)), {-1.5, -1.5, 0}, {1.5, 1.5, 1.5}},
        {"fog, through a corner", boundary_of(medium_of(1, 1)), {-0.5, -0.5, 0.5}, {1.5, 1.5, 1.5}},
        {"a liquid, through a face",
         glass(1.33, medium_of(1, 1)),
         {-0.5, -0.5, 0.5},
         {0.5, 0.5, 1.5}},
    };
    std::set<double> through_rough_glass;  // with nothing in it
    for (const float roughness : {0.0F, 0.3F})
        for (const auto& [what, other, low, high] : cases) {
            SCOPED_TRACE(fmt::format("{}, roughness {}", what, roughness));
            Scene scene = scene_named("block");
            scene.environment = constant_environment(1);
            Material block = glass(1.5);
            block.roughness = roughness;
            add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 10);
            add_box(scene, block, {-1, -1, 0}, {1, 1, 1}, Facing::outward);
            add_box(scene, other, low, high, Facing::outward);
            RenderSettings settings =
                square_settings("mis", perspective({1.5, 2, 4}, {0, 0, 0.5}, 0.5), 32, 32);
            const double mean = image_mean(render_scene(scene, settings)).mean;
            if (roughness > 0) {  // light is lost between facets
                EXPECT_LT(mean, 1);
                if (!other.medium.scatters()) through_rough_glass.insert(mean);
                continue;
            }
            EXPECT_NEAR(mean, 1, 1e-6);
            if (!other.medium.scatters()) continue;
            settings.method.distances = Distances::mis;
            settings.splits = {3, 2, 2};
            settings.split_depth = 2;
            const Strictness strictness{.bias = 0.01, .tests = 3};
            EXPECT_TRUE(
                has_mean(image_mean(render_for(strictness, scene, settings)), 1, strictness));
        }
    EXPECT_EQ(through_rough_glass.size(), 1U);
}

// Glass as hot as the sky around it is not seen: it emits n^2 sigma_a B.
TEST(Dielectric, AtOneTemperatureIsInvisible) {
    Scene scene = scene_named("hot glass");
    scene.environment = constant_environment(1);
    Medium hot = medium_of(0, 0);
    hot.sigma_a = {0.1F, 1, 10};
    for (std::size_t c = 0; c < 3; ++c) hot.emission[c] = 1.5F * 1.5F * hot.sigma_a[c];
    add_box(scene, glass(1.5, hot), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    const Strictness strictness{.tests = 3};
    const RenderSettings settings =
        square_settings("mis", perspective({2, 3, 4}, {0, 0, 0}, 0.6), 32, 16);
    const RenderResult result = render_for(strictness, scene, settings);
    for (const char* channel : {"R", "G", "B"})
        EXPECT_TRUE(has_mean(image_mean(result, channel), 1, strictness)) << channel;
}

// A camera inside sees n^2 of the radiance outside, whatever way it looks.
TEST(Dielectric, RadianceInsideIsNSquared) {
    Scene scene = scene_named("inside");
    scene.environment = constant_environment(1);
    add_icosphere(scene, glass(1.5), {0, 0, 0}, 1, 3);
    const RenderResult result = render_for(
        {}, scene, square_settings("mis", perspective({0.1, 0, 0}, {1, 0.3, 0.2}, 1.2), 16, 256));
    EXPECT_TRUE(has_mean(shared_mean(result), 2.25, {.truth_error = 1e-6}));
}

// Roulette goes by what a path carries but for n^2: every sample of a furnace is 1. Without either
// n it would set in at n > 3, and the mean would have an error of 5e-3.
TEST(Dielectric, IsNoReasonForRoulette) {
    Scene scene = scene_named("ball");
    scene.environment = constant_environment(1);
    add_icosphere(scene, glass(4), {0, 0, 0}, 1, 3);
    RenderSettings settings =
        square_settings("mis", orthographic({0, 0, 2}, {0, 0, 0}, 2.5), 16, 64);
    settings.termination.kind = TerminationKind::roulette;
    const RenderResult result = render_scene(scene, settings);
    // Paths of 1000 scatterings and more between facets are no such paths: 2e-4 is theirs.
    EXPECT_NEAR(image_mean(result).mean, 1, 1e-3);
    EXPECT_LT(image_mean(result).error, 1e-3);
}

// Light points through and on microfacets, against directions of the lobe alone: the same picture.
TEST(Dielectric, RoughBallIsLitAlikeByEveryMethod) {
    Scene scene = scene_named("rough ball");
    scene.environment = constant_environment(0.2F);
    Material material = glass(1.5, medium_of(0.3, 0));
    material.roughness = 0.6F;
    material.base_color = {0.9F, 0.5F, 0.9F};
    add_icosphere(scene, material, {0, 0, 0}, 1, 3);
    add_square(scene, lambert(grey(0), grey(3), true), {0, 0.5, -2.5}, {0, 0, 1}, 2);
    std::vector<RenderResult> results;
    for (const char* method : {"bsdf", "mis"}) {  // direct would take ten times the samples
        RenderSettings settings =
            square_settings(method, perspective({0.5, 0.8, 3}, {0, 0, 0}, 0.5), 32, 1024);
        settings.seed = static_cast<uint32_t>(results.size() + 1);
        results.push_back(render_scene(scene, settings));
    }
    for (const char* channel : {"R", "G"})
        EXPECT_TRUE(agree(
            image_mean(results[0], channel), image_mean(results[1], channel),
            {.bias = 0.015, .tests = 2}))
            << channel;
}

}  // namespace
}  // namespace wavepath
