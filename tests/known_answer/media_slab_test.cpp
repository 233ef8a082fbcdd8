// Plates of a homogeneous medium in a uniform environment: absorption alone, reflectance and
// transmittance by adding-doubling, order by order, channel by channel. A pixel that looks along mu
// measures, by reciprocity, R(mu) + T(mu) with the environment on both sides.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};

// Looks at the middle of the plate's top under cos = mu, from a plane above it.
Camera along(double mu) {
    const double sine = std::sqrt(1 - mu * mu);
    return orthographic({2 * sine, 0, 2 * mu}, {0, 0, 0}, 0.01);
}

Scene slab(const Medium& medium, double half_width = 40) {
    Scene scene = scene_named("slab");
    scene.environment = constant_environment(1);
    add_slab(scene, medium, half_width);
    return scene;
}

Scene with_plane(Scene scene, double z) {
    add_square(scene, lambert(grey(0)), {0, 0, z}, {0, 0, 1}, 160);
    return scene;
}

TEST(MediaSlab, AbsorbsByBeerAndLambert) {
    Medium medium;
    medium.sigma_a = {0.1F, 1, 5};
    for (const char* method : {"path", "direct", "mis"}) {
        for (const double mu : {1.0, 0.5}) {
            const RenderResult result =
                render_scene(slab(medium), square_settings(method, along(mu), 8, 16));
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(
                    shared_mean(result, channels[c]).mean / std::exp(-medium.sigma_a[c] / mu), 1,
                    1e-5)
                    << method << ", mu " << mu << ", channel " << channels[c];
        }
    }
}

struct SlabCase {
    double g, tau, albedo, mu, reflectance, transmittance;
};

constexpr SlabCase slab_cases[] = {
    {0, 0.1, 0.9, 1, .04210143, .94674644},    {0, 1, 0.5, 1, .09911919, .44605839},
    {0, 1, 0.9, 1, .26741034, .59162509},      {0, 1, 0.9, 0.5, .39366166, .41483990},
    {0, 10, 0.9, 1, .41493469, .00561239},     {0.75, 1, 0.9, 1, .05594682, .82791736},
    {0.75, 1, 0.9, 0.5, .17103869, .62234188}, {0.75, 10, 0.9, 1, .16470697, .07375501},
};

TEST(MediaSlab, ReflectsAndTransmitsByAddingDoubling) {
    for (const SlabCase& c : slab_cases) {
        SCOPED_TRACE(fmt::format("g {}, tau {}, albedo {}, mu {}", c.g, c.tau, c.albedo, c.mu));
        const RenderResult result = render_for(
            {.tests = std::size(slab_cases)}, slab(medium_of(c.tau, c.albedo, c.g), 40 / c.tau),
            square_settings("mis", along(c.mu), 32, 64));
        EXPECT_TRUE(has_mean(
            shared_mean(result), c.reflectance + c.transmittance,
            {.tests = std::size(slab_cases), .truth_error = 2e-7}));
    }
}

// A black plane right below hides the environment there.
TEST(MediaSlab, ReflectsAlone) {
    struct Case {
        const char* method;
        SlabCase plate;
    };
    for (const auto& [method, c] :
         {Case{"mis", slab_cases[2]}, Case{"direct", slab_cases[2]}, Case{"mis", slab_cases[6]}}) {
        SCOPED_TRACE(fmt::format("{}, g {}, tau {}, mu {}", method, c.g, c.tau, c.mu));
        const Scene scene = with_plane(slab(medium_of(c.tau, c.albedo, c.g)), -1.001);
        const RenderResult result =
            render_for({.tests = 3}, scene, square_settings(method, along(c.mu), 32, 64));
        EXPECT_TRUE(
            has_mean(shared_mean(result), c.reflectance, {.tests = 3, .truth_error = 1e-6}));
    }
}

// Three optical thicknesses at once: each channel is a plate of its own.
TEST(MediaSlab, KeepsChannelsApart) {
    Medium medium;
    constexpr double taus[] = {0.1, 1, 10};
    constexpr double truths[] = {
        .04210143 + .94674644, .26741034 + .59162509, .41493469 + .00561239};
    for (std::size_t c = 0; c < 3; ++c) {
        medium.sigma_a[c] = static_cast<float>(0.1 * taus[c]);
        medium.sigma_s[c] = static_cast<float>(0.9 * taus[c]);
    }
    const RenderResult result =
        render_for({.tests = 3}, slab(medium, 400), square_settings("mis", along(1), 32, 64), "B");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_TRUE(has_mean(
            shared_mean(result, channels[c]), truths[c], {.tests = 3, .truth_error = 1e-6}))
            << channels[c];
}

// R_k + T_k of k scatterings, tau = 1, isotropic.
constexpr double orders_steep[] = {
    .36787944,
    .14201535 + .10617289,
    .07888152 + .06862215,
    .04668661 + .04360838,
    .02832607 + .02738659,
    .01737144 + .01708273};
constexpr double orders_slant[] = {
    .13533528,
    .21945909 + .12554517,
    .11363797 + .08695905,
    .06500447 + .05702377,
    .03879210 + .03635944,
    .02359812 + .02285096};

TEST(MediaSlab, HasTheOrdersOfTheDepthAsked) {
    constexpr double albedo = 0.9;
    for (const char* method : {"bsdf", "direct"}) {
        for (const double mu : {1.0, 0.5}) {
            double truth = 0;
            for (const uint32_t depth : {0U, 1U, 2U, 3U, 5U}) {
                SCOPED_TRACE(fmt::format("{}, mu {}, depth {}", method, mu, depth));
                truth = 0;
                for (uint32_t k = 0; k <= depth; ++k)
                    truth += std::pow(albedo, k) * (mu == 1 ? orders_steep : orders_slant)[k];
                RenderSettings settings = square_settings(method, along(mu), 32, 64);
                settings.termination = {TerminationKind::depth, depth, 1};
                const RenderResult result =
                    render_for({.tests = 20}, slab(medium_of(1, albedo)), settings);
                EXPECT_TRUE(
                    has_mean(shared_mean(result), truth, {.tests = 20, .truth_error = 1e-6}));
            }
        }
    }
}

// The notes' uniform directions, whose weights have a relative variance of 7 at g = 0.75: one
// scattering.
TEST(MediaSlab, UniformDirectionsChangeNoMean) {
    constexpr double albedo = 0.9;
    const Strictness strictness{.bias = 0.01, .truth_error = 1e-6};
    RenderSettings settings = square_settings("path", along(1), 32, 64);
    settings.method.phase_directions = false;
    settings.termination = {TerminationKind::depth, 1, 1};
    const RenderResult result = render_for(strictness, slab(medium_of(1, albedo, 0.75)), settings);
    EXPECT_TRUE(
        has_mean(shared_mean(result), .36787944 + albedo * (.01656728 + .30221870), strictness));
}

}  // namespace
}  // namespace wavepath
