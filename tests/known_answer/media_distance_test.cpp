// Ways to choose stops in a medium: one mean, and the variances that quadrature predicts where both
// terms of a segment are taken.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr Distances all_distances[] = {
    Distances::exponential, Distances::uniform, Distances::truncated, Distances::equiangular,
    Distances::mis};

// A point light in a medium at `height` from a ray of length 10 that passes it half way and ends at
// a black wall. Single scattering, times 4 pi / sigma_s: the integral of exp(-sigma (t + r)) / r^2.
struct Airlight {
    double sigma, height, integral;

    Scene scene() const {
        Scene s = scene_named("airlight");
        add_box(
            s, boundary_of(medium_of(sigma, 1)), {-40, -40, -40}, {40, 40, 40}, Facing::outward);
        add_square(s, lambert(grey(0)), {0, 0, -10}, {0, 0, 1}, 1);
        PunctualLight light;
        light.position = {height, 0, -5};
        s.lights.push_back(light);
        return s;
    }

    double radiance() const { return sigma / (4 * std::numbers::pi) * integral; }

    RenderSettings settings(Distances distances, uint32_t size, uint64_t samples) const {
        RenderSettings settings =
            square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, 1e-5), size, samples);
        settings.termination = {TerminationKind::depth, 1, 1};
        settings.method.distances = distances;
        settings.sobol = false;
        return settings;
    }
};

constexpr Airlight near_thin{0.1, 0.1, 18.304568};
constexpr Airlight near_dense{1, 0.1, .17262769};
constexpr Airlight far_dense{1, 2, .0016234465};

TEST(MediaDistance, HasThePredictedVarianceAboutAPointLight) {
    const struct {
        const Airlight& airlight;
        Distances distances;
        double relative_variance;
    } cases[] = {
        {near_thin, Distances::uniform, 15.8173},
        {near_thin, Distances::truncated, 16.5245},
        {near_thin, Distances::equiangular, .00352599},
        {near_thin, Distances::mis, .713022},
        {near_dense, Distances::uniform, 17.9077},
        {near_dense, Distances::equiangular, .0649303},
        {near_dense, Distances::mis, 1.04344},
        {far_dense, Distances::uniform, .826229},
        {far_dense, Distances::truncated, 6.85839},
        {far_dense, Distances::equiangular, .97311},
        {far_dense, Distances::mis, .879134}};
    for (const auto& [airlight, distances, relative_variance] : cases) {
        SCOPED_TRACE(fmt::format(
            "sigma {}, height {}, {}", airlight.sigma, airlight.height, name_of(distances)));
        const RenderResult result =
            render_scene(airlight.scene(), airlight.settings(distances, 256, 1));
        const double mean = airlight.radiance();
        EXPECT_TRUE(has_mean(
            sample_variance(result), relative_variance * mean * mean,
            {.bias = 0.2, .tests = std::size(cases)}));
        EXPECT_TRUE(has_mean(
            shared_mean(result), mean,
            {.bias = 0.15, .tests = std::size(cases), .truth_error = 2e-5}));
    }
}

TEST(MediaDistance, HasTheMeanOfAirlight) {
    for (const auto& [airlight, distances] :
         {std::pair{near_thin, Distances::mis}, std::pair{near_dense, Distances::equiangular}}) {
        const Strictness strictness{.tests = 2, .truth_error = 2e-5};
        RenderSettings settings = airlight.settings(distances, 32, 64);
        settings.sobol = true;
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, airlight.scene(), settings)), airlight.radiance(),
            strictness))
            << name_of(distances);
    }
}

// One stop, one direction, the environment all round, both terms of both segments: quadrature.
TEST(MediaDistance, HasThePredictedVarianceInASlab) {
    const struct {
        double tau, mean;
        Distances distances;
        double relative_variance;
    } cases[] = {
        {0.1, .0796595274, Distances::uniform, .0573673},
        {0.1, .0796595274, Distances::truncated, .0564596},
        {1, .2481882401, Distances::uniform, .735609},
        {1, .2481882401, Distances::truncated, .54535},
        {5, .1584950295, Distances::uniform, 14.2736},
        {5, .1584950295, Distances::truncated, 2.78927}};
    for (const auto& [tau, mean, distances, relative_variance] : cases) {
        SCOPED_TRACE(fmt::format("tau {}, {}", tau, name_of(distances)));
        Scene scene = scene_named("slab");
        scene.environment = constant_environment(1);
        add_slab(scene, medium_of(tau, 1), 400 / tau);
        RenderSettings settings =
            square_settings("path", orthographic({0, 0, 2}, {0, 0, 0}, 0.01), 256, 1);
        settings.termination = {TerminationKind::depth, 1, 1};
        settings.method.distances = distances;
        settings.split_depth = 2;
        settings.sobol = false;
        const RenderResult result = render_scene(scene, settings);
        EXPECT_TRUE(has_mean(
            sample_variance(result), relative_variance * mean * mean,
            {.bias = 0.2, .tests = std::size(cases)}));
        EXPECT_TRUE(has_mean(
            shared_mean(result), std::exp(-tau) + mean,
            {.bias = 0.15, .tests = std::size(cases), .truth_error = 1e-5}));
    }
}

// A ball whose wall (albedo 0.5, emission 1) is filled with a medium of sigma R = 0.5, albedo 0.5,
// seen from its centre, by its integral equation. Also the notes' own estimator of section 6, and
// splits.
TEST(MediaDistance, ChangesNoMeanInACavity) {
    constexpr int subdivisions = 4;
    Scene scene = scene_named("cavity");
    add_icosphere(scene, lambert(grey(0.5F), grey(1)), {0, 0, 0}, 1, subdivisions, Facing::inward);
    add_box(
        scene, boundary_of(medium_of(0.5, 0.5)), {-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2},
        Facing::outward);
    struct Case {
        const char* method;
        Distances distances;
        bool phase = true;
        Splits splits = {};
        uint32_t depth = 1;
    };
    const std::vector<Case> cases{
        {"mis", Distances::truncated},
        {"mis", Distances::equiangular},
        {"mis", Distances::mis, true, {}, 0},
        {"path", Distances::uniform, false},
        {"path", Distances::uniform, false, {2, 2, 2}, 2},
        {"direct", Distances::mis, true, {3, 2, 1}},
        {"mis", Distances::exponential, true, {1, 3, 1}}};
    for (const Case& c : cases) {
        SCOPED_TRACE(fmt::format(
            "{}, {}, splits {},{},{} to {}", c.method, name_of(c.distances), c.splits.stops,
            c.splits.directions, c.splits.reflections, c.depth));
        RenderSettings settings =
            square_settings(c.method, perspective({0, 0, 0}, {1, 0.3, 0.2}, 1), 32, 16);
        settings.method.distances = c.distances;
        settings.method.phase_directions = c.phase;
        settings.splits = c.splits;
        settings.split_depth = c.depth;
        const Strictness strictness{
            .bias = 0.01, .tests = cases.size(), .truth_error = icosphere_sagitta(subdivisions)};
        EXPECT_TRUE(
            has_mean(image_mean(render_for(strictness, scene, settings)), 1.195216705, strictness));
    }
}

// Weights and roulette of children leave no other trace either: coloured media, boundaries in the
// way, a lamp in the fog.
TEST(MediaDistance, ChangesNoMeanInARoom) {
    Scene scene = scene_named("foggy room");
    add_box(scene, lambert({0.7F, 0.5F, 0.4F}), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    add_square(scene, lambert(grey(0), grey(6)), {0, 0.9, 0}, {0, -1, 0}, 0.8);
    Medium fog = medium_of(0.8, 0.9, 0.5);
    fog.sigma_a = {0.3F, 0.1F, 0};
    add_box(scene, boundary_of(fog), {-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}, Facing::outward);
    add_icosphere(scene, boundary_of(medium_of(4, 0.9, -0.3)), {-0.3, -0.3, 0}, 0.4, 2);
    std::vector<RenderResult> results;
    for (const Distances distances : all_distances) {
        RenderSettings settings =
            square_settings("mis", perspective({0.8, 0.2, 0.9}, {-0.2, -0.4, -0.3}, 1.2), 64, 224);
        settings.method.distances = distances;
        settings.split_depth = 2;
        settings.seed = static_cast<uint32_t>(results.size() + 1);
        results.push_back(render_scene(scene, settings));
    }
    for (std::size_t k = 1; k < results.size(); ++k)
        for (const char* channel : {"R", "B"})
            EXPECT_TRUE(agree(
                image_mean(results[0], channel), image_mean(results[k], channel),
                {.bias = 0.03, .tests = 8}))
                << name_of(all_distances[k]) << ", " << channel;
}

}  // namespace
}  // namespace wavepath
