// What one sample in a medium varies by: closed forms and quadrature, where the fourth moment
// exists, with both terms of a segment taken; and what splitting buys for which cost.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <map>
#include <numbers>

namespace wavepath {
namespace {

RenderSettings single_scattering(
    const char* method,
    const Camera& camera,
    Distances distances,
    uint32_t split_depth,
    uint32_t size = 256) {
    RenderSettings settings = square_settings(method, camera, size, 1);
    settings.termination = {TerminationKind::depth, 1, 1};
    settings.method.distances = distances;
    settings.split_depth = split_depth;
    settings.sobol = false;
    return settings;
}

const Camera along_the_needle = orthographic({0, 0, 0.5}, {0, 0, 0}, 1e-6);

// A needle of a medium along the view, of length 1, before a black square in a sky of radiance 1:
// what scatters leaves by the side and finds the sky for certain, so that nothing varies but how
// it was made to scatter.
Scene needle(const Medium& medium, const Rgb& tint = {1, 1, 1}) {
    constexpr double half = 5e-5;
    Scene scene = scene_named("needle");
    scene.environment = constant_environment(1);
    Material boundary = boundary_of(medium);
    boundary.base_color = tint;
    add_box(scene, boundary, {-half, -half, -1}, {half, half, 0}, Facing::outward);
    add_square(scene, lambert(grey(0)), {0, 0, -1.00001}, {0, 0, 1}, 4 * half);
    return scene;
}

// 1 - exp(-tau) of the light scatters, with tau / 2 coth(tau / 2) - 1, 1 / (exp(tau) - 1) where the
// path may go on instead, and 0.
TEST(MediaVariance, OfOneStopOnANeedle) {
    const struct {
        Distances distances;
        double tau, relative_variance;
    } cases[] = {{Distances::uniform, 1, .081976707},  {Distances::uniform, 5, 1.5339183},
                 {Distances::uniform, 10, 4.000454},   {Distances::uniform, 20, 9},
                 {Distances::uniform, 100, 49},        {Distances::exponential, 0.01, 99.5},
                 {Distances::exponential, 0.1, 9.508}, {Distances::exponential, 1, .58198},
                 {Distances::truncated, 1, 0}};
    for (const auto& c : cases) {
        SCOPED_TRACE(fmt::format("{}, tau {}", name_of(c.distances), c.tau));
        const RenderResult result = render_scene(
            needle(medium_of(c.tau, 1, 0.5)),
            single_scattering(
                "path", along_the_needle, c.distances, 1, c.relative_variance < 20 ? 256 : 1024));
        // the needle is not quite thin: a share of 10^-3 scatters once more
        const double mean = 1 - std::exp(-c.tau);
        const Estimate variance = sample_variance(result);
        if (c.relative_variance == 0)
            EXPECT_LT(variance.mean, 2e-3 * mean * mean);
        else
            EXPECT_TRUE(has_mean(
                variance, c.relative_variance * mean * mean,
                {.bias = 0.2, .tests = std::size(cases), .truth_error = 2e-3}));
        EXPECT_TRUE(has_mean(
            shared_mean(result), mean,
            {.bias = 0.1, .tests = std::size(cases), .truth_error = 2e-3}));
    }
}

// The notes' uniform directions where the phase function is not: (1 + g^2) / (1 - g^2)^2 - 1. Their
// own error grows towards g = 1.
TEST(MediaVariance, OfUniformDirectionsOnANeedle) {
    const std::pair<double, uint32_t> cases[] = {{0.5, 256}, {-0.75, 512}, {0.9, 1536}};
    constexpr double tau = 1e-3;
    for (const auto& [g, size] : cases) {
        SCOPED_TRACE(g);
        RenderSettings settings =
            single_scattering("path", along_the_needle, Distances::truncated, 1, size);
        settings.method.phase_directions = false;
        const RenderResult result = render_scene(needle(medium_of(tau, 1, g)), settings);
        const double mean = 1 - std::exp(-tau);
        const double relative_variance = (1 + g * g) / std::pow(1 - g * g, 2) - 1;
        EXPECT_TRUE(has_mean(
            sample_variance(result), relative_variance * mean * mean,
            {.bias = 0.2, .tests = std::size(cases), .truth_error = 2e-3}));
        EXPECT_TRUE(has_mean(
            shared_mean(result), mean,
            {.bias = 0.1, .tests = std::size(cases), .truth_error = 2e-3}));
    }
}

// Two colours whose extinctions differ by k, an infinite segment: the distance is drawn for either,
// half the time each, and weighed by both densities. By quadrature, for both colours alike.
// Weighing one by the other's density would have infinite variance.
TEST(MediaVariance, OfTwoColoursIsThatOfTheirBalance) {
    constexpr double slow = 10;
    for (const auto& [k, relative_variance] : {std::pair{3.0, .2092}, std::pair{10.0, .5565}}) {
        Medium medium;
        medium.sigma_s = {slow, static_cast<float>(k * slow), 1};
        const RenderResult result = render_scene(
            needle(medium, {1, 1, 0}),
            single_scattering("path", along_the_needle, Distances::exponential, 1));
        for (const char* channel : {"R", "G"}) {
            SCOPED_TRACE(fmt::format("k {}, {}", k, channel));
            const Strictness strictness{.bias = 0.15, .tests = 8, .truth_error = 2e-2};
            EXPECT_TRUE(has_mean(sample_variance(result, channel), relative_variance, strictness));
            EXPECT_TRUE(has_mean(shared_mean(result, channel), 1, strictness));
        }
    }
}

// A colour of which the path carries next to nothing has its distances drawn for the other: 1 / (k
// (2 - k)) - 1, k the ratio of their extinctions. The fourth moment ends at k = 4/3.
TEST(MediaVariance, OfAColourDrawnForAnother) {
    constexpr double slow = 10;
    constexpr double carried = 1e-3;
    for (const auto& [k, relative_variance] : {std::pair{0.1, 4.263}, std::pair{0.5, 1.0 / 3}}) {
        SCOPED_TRACE(k);
        Medium medium;
        medium.sigma_s = {static_cast<float>(slow / k), slow, 1};
        const RenderResult result = render_scene(
            needle(medium, {static_cast<float>(carried), 1, 0}),
            single_scattering("path", along_the_needle, Distances::exponential, 1));
        // in and out by the tinted boundary
        const double mean = carried * carried;
        const Strictness strictness{.bias = 0.15, .tests = 4, .truth_error = 2e-2};
        EXPECT_TRUE(has_mean(sample_variance(result), relative_variance * mean * mean, strictness));
        EXPECT_TRUE(has_mean(shared_mean(result), mean, strictness));
    }
}

Scene slab(double tau) {
    Scene scene = scene_named("slab");
    add_slab(scene, medium_of(tau, 1), 400 / tau);
    return scene;
}

// Against the sun, which shines straight through the plate: it reaches every stop and leaves it
// over exp(-tau) in all. Stops alike for all of them have no variance; those of a truncated
// exponential (1 - exp(-tau)) (exp(tau) - 1) / tau^2 - 1, whose own error grows as exp(tau / 2): at
// tau 20 it would take 10^11 samples (0 here).
TEST(MediaVariance, OfALightBehindADensePlate) {
    const struct {
        double tau, relative_variance;
        uint32_t size;
    } cases[] = {{5, 4.85680, 256}, {10, 219.245, 2816}, {20, 0, 0}};
    for (const auto& [tau, relative_variance, size] : cases) {
        SCOPED_TRACE(tau);
        Scene scene = slab(tau);
        PunctualLight sun;
        sun.kind = LightKind::directional;
        sun.direction = {0, 0, 1};
        scene.lights.push_back(sun);
        const double mean = tau * std::exp(-tau) / (4 * std::numbers::pi);
        const RenderResult even =
            render_scene(scene, single_scattering("mis", along(1), Distances::uniform, 1));
        EXPECT_LT(sample_variance(even).mean, 1e-9 * mean * mean);
        EXPECT_NEAR(shared_mean(even).mean / mean, 1, 1e-5);
        if (relative_variance == 0) continue;
        const RenderResult truncated =
            render_scene(scene, single_scattering("mis", along(1), Distances::truncated, 1, size));
        EXPECT_TRUE(has_mean(
            sample_variance(truncated), relative_variance * mean * mean,
            {.bias = 0.25, .tests = 4}));
        EXPECT_TRUE(
            has_mean(shared_mean(truncated), mean, {.bias = 0.1, .tests = 4, .truth_error = 1e-5}));
    }
}

// One stop, one direction, a sky all round, both terms of both segments: quadrature.
TEST(MediaVariance, OfASlab) {
    const struct {
        double tau, mean;
        Distances distances;
        double relative_variance;
    } cases[] = {
        {0.1, .0796595274, Distances::uniform, .0573673},
        {1, .2481882401, Distances::uniform, .735609},
        {5, .1584950295, Distances::uniform, 14.2736},
        {20, .1534264125, Distances::uniform, 64.1778},
        {100, .1534264125, Distances::uniform, 324.889},
        {0.1, .0796595274, Distances::truncated, .0564596},
        {5, .1584950295, Distances::truncated, 2.78927},
        {20, .1534264125, Distances::truncated, 3.01598},
        {100, .1534264125, Distances::truncated, 3.01598}};
    for (const auto& [tau, mean, distances, relative_variance] : cases) {
        SCOPED_TRACE(fmt::format("tau {}, {}", tau, name_of(distances)));
        Scene scene = slab(tau);
        scene.environment = constant_environment(1);
        const uint32_t size = relative_variance < 20 ? 256 : relative_variance < 100 ? 512 : 1280;
        const RenderResult result =
            render_scene(scene, single_scattering("path", along(1), distances, 2, size));
        EXPECT_TRUE(has_mean(
            sample_variance(result), relative_variance * mean * mean,
            {.bias = 0.2, .tests = std::size(cases)}));
        EXPECT_TRUE(has_mean(
            shared_mean(result), std::exp(-tau) + mean,
            {.bias = 0.15, .tests = std::size(cases), .truth_error = 1e-5}));
    }
}

// N stops of M directions each: (B + W / M) / N, B the variance between stops, W the mean variance
// within one, by quadrature; at the cost of as many rays as there are children.
TEST(MediaVariance, OfSplitsInASlab) {
    constexpr double tau = 1;
    constexpr double mean = .2481882401;
    constexpr double between = .00170055;
    constexpr double within = .03189159;
    Scene scene = slab(tau);
    scene.environment = constant_environment(1);
    std::map<uint32_t, double> rays;  // by N M
    for (const auto& [stops, directions] :
         {std::pair{1U, 1U}, std::pair{1U, 4U}, std::pair{4U, 1U}, std::pair{2U, 3U}}) {
        SCOPED_TRACE(fmt::format("{} stops, {} directions", stops, directions));
        RenderSettings settings = single_scattering("path", along(1), Distances::truncated, 2);
        settings.splits = {stops, directions, 1};
        const RenderResult result = render_scene(scene, settings);
        EXPECT_TRUE(has_mean(
            sample_variance(result), (between + within / directions) / stops,
            {.bias = 0.1, .tests = 8}));
        EXPECT_TRUE(has_mean(
            shared_mean(result), std::exp(-tau) + mean,
            {.bias = 0.02, .tests = 8, .truth_error = 1e-5}));
        const auto traced = static_cast<double>(result.rays.closest);
        const auto known = rays.emplace(stops * directions, traced).first;
        // a few rays at a slant are extinguished on the way
        EXPECT_NEAR(traced / known->second, 1, 1e-3);
    }
    EXPECT_NEAR((rays[6] - rays[1]) / (rays[4] - rays[1]), 5.0 / 3, 0.01);
}

}  // namespace
}  // namespace wavepath
