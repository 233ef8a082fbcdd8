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

// The last is MCML's benchmark [van de Hulst 1980: .09739 and .66096].
TEST(MediaSlab, ReflectsAndTransmitsByAddingDoubling) {
    const struct {
        double g, tau, albedo, mu, reflectance, transmittance;
    } cases[] = {
        {0, 1, 0.9, 0.5, .39366166, .41483990},
        {0.75, 1, 0.9, 0.5, .17103869, .62234188},
        {0.75, 2, 0.9, 1, .0973946387, .6609577002},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(fmt::format("g {}, tau {}, albedo {}, mu {}", c.g, c.tau, c.albedo, c.mu));
        const Strictness strictness{.tests = std::size(cases), .truth_error = 2e-7};
        const RenderResult result = render_for(
            strictness, slab(medium_of(c.tau, c.albedo, c.g), 40 / c.tau),
            square_settings("mis", along(c.mu), 32, 64));
        EXPECT_TRUE(has_mean(shared_mean(result), c.reflectance + c.transmittance, strictness));
    }
}

// A black plane right below hides the environment there.
TEST(MediaSlab, ReflectsAlone) {
    Scene scene = slab(medium_of(1, 0.9));
    add_square(scene, lambert(grey(0)), {0, 0, -1.001}, {0, 0, 1}, 160);
    const Strictness strictness{.truth_error = 1e-6};
    const RenderResult result =
        render_for(strictness, scene, square_settings("mis", along(0.5), 32, 64));
    EXPECT_TRUE(has_mean(shared_mean(result), .39366166, strictness));
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
    // dense blue takes the most samples: 1 % will do there
    const Strictness strictness[] = {
        {.tests = 3, .truth_error = 1e-6},
        {.tests = 3, .truth_error = 1e-6},
        {.bias = 0.01, .tests = 3, .truth_error = 1e-6}};
    const RenderResult result =
        render_for(strictness[2], slab(medium, 400), square_settings("mis", along(1), 32, 64), "B");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truths[c], strictness[c]))
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
    const struct {
        const char* method;
        double mu;
        uint32_t depth;
    } cases[] = {{"bsdf", 1, 0}, {"bsdf", 1, 1}, {"direct", 0.5, 1}, {"bsdf", 0.5, 3}};
    for (const auto& [method, mu, depth] : cases) {
        SCOPED_TRACE(fmt::format("{}, mu {}, depth {}", method, mu, depth));
        double truth = 0;
        for (uint32_t k = 0; k <= depth; ++k)
            truth += std::pow(albedo, k) * (mu == 1 ? orders_steep : orders_slant)[k];
        RenderSettings settings = square_settings(method, along(mu), 32, 64);
        settings.termination = {TerminationKind::depth, depth, 1};
        const Strictness strictness{.tests = std::size(cases), .truth_error = 1e-6};
        const RenderResult result = render_for(strictness, slab(medium_of(1, albedo)), settings);
        EXPECT_TRUE(has_mean(shared_mean(result), truth, strictness));
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
