// S1: a closed box of Lambert walls that all emit. L = Le / (1 - rho) at every point, and with at
// most D scatterings L_D = Le (1 - rho^(D+1)) / (1 - rho). The channels hold three albedos at once.
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

constexpr double albedos[] = {0.5, 0.8, 0.9};
constexpr const char* channels[] = {"R", "G", "B"};

Scene furnace() {
    Scene scene = scene_named("furnace");
    add_box(scene, lambert({0.5F, 0.8F, 0.9F}, grey(1)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    return scene;
}

const Camera inside = perspective({0.2, 0.1, 0.3}, {-1, -0.4, -0.9}, 1.6);

TEST(Furnace, GivesTheGeometricSeries) {
    for (const char* method : {"path", "bsdf", "mis"}) {
        // albedo .9 has a relative variance of .9 by roulette alone: 2e6 samples to find 0.5 %
        const RenderResult result =
            render_scene(furnace(), square_settings(method, inside, 64, 512));
        for (int c = 0; c < 3; ++c) {
            SCOPED_TRACE(fmt::format("{}, albedo {}", method, albedos[c]));
            const double truth = 1 / (1 - albedos[c]);
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth));
            for (const Estimate& block : block_means(result, channels[c]))
                EXPECT_TRUE(has_mean(block, truth, {.bias = 0.1, .tests = 64}));
        }
    }
}

TEST(Furnace, StopsAtTheDepthAsked) {
    for (const char* method : {"path", "bsdf", "mis"}) {
        for (const uint32_t depth : {0U, 1U, 2U, 5U, 10U}) {
            // emission met by chance makes every sample the same: one will do
            const uint64_t samples = std::string(method) == "mis" ? 128 : 1;
            RenderSettings settings = square_settings(method, inside, 64, samples);
            settings.termination = {TerminationKind::depth, depth, 1};
            const RenderResult result = render_scene(furnace(), settings);
            for (int c = 0; c < 3; ++c) {
                SCOPED_TRACE(fmt::format("{}, depth {}, albedo {}", method, depth, albedos[c]));
                const double truth = (1 - std::pow(albedos[c], depth + 1)) / (1 - albedos[c]);
                EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth));
            }
        }
    }
}

// Three directions from each of the first two vertices, a third of the throughput each.
TEST(Furnace, SplitsChangeNoMean) {
    for (const char* method : {"path", "mis"}) {
        for (const TerminationKind kind : {TerminationKind::roulette, TerminationKind::depth}) {
            RenderSettings settings = square_settings(method, inside, 64, 16);
            settings.splits.reflections = 3;
            settings.split_depth = 2;
            settings.termination = {kind, 4, 1};
            const RenderResult result = render_scene(furnace(), settings);
            for (int c = 0; c < 2; ++c) {
                const bool cut = kind == TerminationKind::depth;
                SCOPED_TRACE(fmt::format("{}, albedo {}, cut {}", method, albedos[c], cut));
                const double rho = albedos[c];
                EXPECT_TRUE(has_mean(
                    shared_mean(result, channels[c]),
                    (1 - (cut ? std::pow(rho, 5) : 0)) / (1 - rho), {.tests = 8}));
            }
        }
    }
}

// From every point of a sphere cosine-distributed directions reach all of it alike, so what a
// vertex emits is drawn anew at each: v = f (1 - f) where a share f emits 1. S directions from
// every vertex: Var = v sum of (rho^2 / S)^k over the levels, at the cost of sum of S^k rays. That
// is what splitting buys, in media as well.
TEST(Furnace, SplitsHaveThePredictedVarianceAndCost) {
    constexpr float rho = 0.8F;
    Scene scene = scene_named("two-tone ball");
    add_icosphere(scene, lambert(grey(rho), grey(1)), {0, 0, 0}, 1, 3, Facing::inward);
    // the first quarter lies around the corner (-1, phi, 0)
    split_off(scene, scene.primitives.back().indices.size() / 4, lambert(grey(rho)));
    for (const uint32_t splits : {1U, 4U}) {
        SCOPED_TRACE(splits);
        RenderSettings settings =
            square_settings("path", perspective({0, 0, 0}, {1, -1.6, 0}, 0.3), 256, 1);
        settings.sobol = false;
        settings.termination = {TerminationKind::depth, 3, 1};
        settings.splits.reflections = splits;
        settings.split_depth = 3;
        const RenderResult result = render_scene(scene, settings);
        constexpr double v = 0.25 * 0.75;
        double variance = 0;
        double mean = 0;
        uint64_t rays = 1;
        uint64_t nodes = 1;
        for (int level = 1; level <= 3; ++level) {
            variance += v * std::pow(double{rho} * rho / splits, level);
            mean += 0.25 * std::pow(double{rho}, level);
            rays += nodes *= splits;
        }
        // flat faces do not see themselves
        const Strictness strictness{.bias = 0.05, .tests = 4, .truth_error = 5e-3};
        EXPECT_TRUE(has_mean(sample_variance(result), variance, strictness));
        EXPECT_TRUE(has_mean(shared_mean(result), mean, strictness));
        EXPECT_EQ(result.rays.closest, 65536 * rays);
    }
}

// Survival r at every vertex: E X^2 = (1 + rho) / (1 - rho) / (1 - rho^2 / r). Asserted where r >
// rho^(4/3), so that the fourth moment exists and the measured variance means something.
TEST(Furnace, RouletteHasThePredictedVariance) {
    for (const float survival : {0.8F, 0.9F}) {
        RenderSettings settings = square_settings("path", inside, 512, 1);
        settings.sobol = false;
        settings.termination = {TerminationKind::roulette_constant, 0, survival};
        const RenderResult result = render_scene(furnace(), settings);
        for (int c = 0; c < 3; ++c) {
            if (survival <= std::pow(albedos[c], 4.0 / 3)) continue;
            SCOPED_TRACE(fmt::format("survival {}, albedo {}", survival, albedos[c]));
            const double rho = albedos[c];
            const double second = (1 + rho) / (1 - rho) / (1 - rho * rho / survival);
            EXPECT_TRUE(has_mean(
                sample_variance(result, channels[c]), second - 1 / ((1 - rho) * (1 - rho)),
                {.bias = 0.1}));
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), 1 / (1 - rho), {.bias = 0.02}));
        }
    }
}

// The variance layer against the scatter of pixels that share one truth.
TEST(Furnace, VarianceLayerIsTheVarianceOfTheMean) {
    RenderSettings settings = square_settings("path", inside, 64, 64);
    settings.sobol = false;
    const RenderResult result = render_scene(furnace(), settings);
    const Estimate layer = image_mean(result);
    const Estimate scatter = shared_mean(result);
    // 1 / sqrt(2 * 4096) of the scatter's error is chance, five times that is the limit
    EXPECT_NEAR(layer.error / scatter.error, 1, 0.06);
}

// Walls that emit touch one another: light points near an edge have samples of tail index 3/2, at
// the second vertex for every pixel.
TEST(Furnace, SlopesOfLightSampling) {
    const auto slope = [&](const char* method) {
        RenderSettings settings = square_settings(method, inside, 8, 1);
        settings.termination = {TerminationKind::depth, 2, 1};
        return error_slope(furnace(), settings, 64, 2048, "B");
    };
    EXPECT_NEAR(slope("direct"), -1.0 / 3, 0.1);
    EXPECT_NEAR(slope("direct-bsdf"), -1.0 / 3, 0.1);
}

// Survival r <= rho^2: tail index a = ln(1/r) / ln(rho/r) < 2, slope -(1 - 1/a).
TEST(Furnace, SlopesOfRouletteThatKillsTooMany) {
    for (const auto& [survival, slope] : {std::pair{0.5F, -0.152}, {0.7F, -0.295}}) {
        SCOPED_TRACE(survival);
        RenderSettings settings = square_settings("path", inside, 8, 1);
        settings.termination = {TerminationKind::roulette_constant, 0, survival};
        EXPECT_NEAR(error_slope(furnace(), settings, 64, 2048, "B"), slope, 0.07);
    }
}

// 100 vertices a path and more; the relative variance is .99 where q is the throughput.
TEST(Furnace, AlbedoOf99Percent_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    Scene scene = scene_named("bright furnace");
    add_box(scene, lambert(grey(0.99F), grey(1)), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    for (const char* method : {"path", "mis"}) {
        SCOPED_TRACE(method);
        const RenderResult result = render_for({}, scene, square_settings(method, inside, 64, 64));
        EXPECT_TRUE(has_mean(shared_mean(result), 1 / (1 - double{0.99F})));
    }
}

}  // namespace
}  // namespace wavepath
