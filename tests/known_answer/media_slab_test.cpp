// Plates of a homogeneous medium in a uniform environment: absorption alone, reflectance and
// transmittance by adding-doubling, order by order, channel by channel. A pixel that looks along mu
// measures, by reciprocity, R(mu) + T(mu) with the environment on both sides.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};

Scene slab(const Medium& medium, double half_width = 40) {
    Scene scene = scene_named("slab");
    scene.environment = constant_environment(1);
    add_slab(scene, medium, half_width);
    return scene;
}

TEST(MediaSlab, AbsorbsByBeerAndLambert) {
    Medium medium;
    medium.sigma_a = {0.1F, 1, 5};
    for (const double mu : {1.0, 0.5}) {
        const RenderResult result =
            render_scene(slab(medium), square_settings("path", along(mu), 8, 16));
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(
                shared_mean(result, channels[c]).mean / std::exp(-medium.sigma_a[c] / mu), 1, 1e-5)
                << "mu " << mu << ", channel " << channels[c];
    }
}

// MCML's benchmark [van de Hulst 1980: .09739 and .66096], each by itself: a sky above a black
// floor, a floor that shines under a black sky. What is reflected is the
// noisier, and more of the plainest paths are had for the same work.
TEST(MediaSlab, ReflectsAndTransmitsAsVanDeHulstSays) {
    for (const bool reflects : {true, false}) {
        SCOPED_TRACE(reflects ? "reflects" : "transmits");
        Scene scene = scene_named("MCML");
        if (reflects) scene.environment = constant_environment(1);
        add_mirrored_slab(scene, medium_of(2, 0.9, 0.75));
        add_floor(scene, lambert(grey(0), grey(reflects ? 0 : 1)));
        const Strictness strictness{.tests = 2, .truth_error = 2e-7};
        RenderSettings settings = square_settings("bsdf", along(1), 32, 256);
        if (!reflects) {
            settings.method.distances = Distances::truncated;
            settings.split_depth = 2;
        }
        const RenderResult result = render_for(strictness, scene, settings);
        EXPECT_TRUE(
            has_mean(shared_mean(result), reflects ? .0973946387 : .6609577002, strictness));
    }
}

// Mirrors for sides; three albedos in one render. The noise is most where most is absorbed.
TEST(MediaSlab, OfMirrorsIsInfinite) {
    constexpr Rgb albedos{0.5F, 0.9F, 0.999F};
    const struct {
        double g, mu;
        double truth[3];
    } cases[] = {
        {0, 0.5, {.14975384 + .23028520, .39366166 + .41483990, .49717377 + .50060946}},
        {0.75, 0.1, {.16670684 + .06749877, .45192169 + .29269231, .57996659 + .41700577}}};
    const Strictness strictness{.tests = 6, .truth_error = 2e-7};
    for (const auto& [g, mu, truth] : cases) {
        Scene scene = scene_named("mirrors");
        scene.environment = constant_environment(1);
        add_mirrored_slab(scene, medium_of(1, albedos, g));
        const RenderResult result =
            render_for(strictness, scene, square_settings("bsdf", along(mu), 16, 256));
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
                << "g " << g << ", mu " << mu << ", albedo " << albedos[c];
    }
}

// Albedo 1: under a bright sky over a black floor a plate shows R, under a black sky over a bright
// floor T, and R + T = 1.
TEST(MediaSlab, LosesNothingBetweenReflectionAndTransmission) {
    Scene above = scene_named("bright sky");
    above.environment = constant_environment(1);
    add_mirrored_slab(above, medium_of(1, 1));
    add_floor(above, lambert(grey(0)));
    Scene below = scene_named("bright floor");
    add_mirrored_slab(below, medium_of(1, 1));
    add_floor(below, lambert(grey(0), grey(1)));
    const RenderSettings settings = square_settings("bsdf", along(0.5), 32, 64);
    const Strictness strictness{.tests = 3, .truth_error = 1e-7};
    const Estimate reflected = shared_mean(render_for(strictness, above, settings));
    const Estimate transmitted = shared_mean(render_for(strictness, below, settings));
    EXPECT_TRUE(has_mean(reflected, .49837553, strictness));
    EXPECT_TRUE(has_mean(transmitted, .50162447, strictness));
    const Estimate sum = {
        reflected.mean + transmitted.mean, std::hypot(reflected.error, transmitted.error),
        reflected.degrees};
    EXPECT_TRUE(has_mean(sum, 1, {.tests = 3}));
}

// Over Lambert's floor of albedo rho: R(mu) + T(mu) rho Td / (1 - rho Rd), Rd and Td those of
// diffuse light.
TEST(MediaSlab, LiesOnAFloor) {
    const struct {
        double tau, albedo, g, rho;
        double truth[2];  // mu 1, .5
    } cases[] = {
        {1, 0.9, 0, 0.5, {.437915775, .513217880}},
        {1, 0.9, 0.75, 0.8, {.568756841, .556515755}},
        {10, 1, 0, 0.5, {.868371593, .908886773}}};
    for (const auto& [tau, albedo, g, rho, truth] : cases) {
        Scene scene = scene_named("floor");
        scene.environment = constant_environment(1);
        add_mirrored_slab(scene, medium_of(tau, albedo, g));
        add_floor(scene, lambert(grey(static_cast<float>(rho))));
        const Strictness strictness{.tests = 6, .truth_error = 1e-6};
        for (std::size_t k = 0; k < 2; ++k) {
            const RenderSettings settings =
                square_settings("bsdf", along(k == 0 ? 1 : 0.5), 32, 64);
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, scene, settings)), truth[k], strictness))
                << "tau " << tau << ", g " << g << ", view " << k;
        }
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
    // dense blue takes the most samples: 1 % will do there
    const Strictness strictness[] = {
        {.tests = 3, .truth_error = 1e-6},
        {.tests = 3, .truth_error = 1e-6},
        {.bias = 0.01, .tests = 3, .truth_error = 1e-6}};
    const RenderResult result = render_for(
        strictness[2], slab(medium, 400), square_settings("mis", along(1), 16, 256), "B");
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
        RenderSettings settings = square_settings(method, along(mu), 16, 256);
        settings.termination = {TerminationKind::depth, depth, 1};
        const Strictness strictness{.tests = std::size(cases), .truth_error = 1e-6};
        const RenderResult result = render_for(strictness, slab(medium_of(1, albedo)), settings);
        EXPECT_TRUE(has_mean(shared_mean(result), truth, strictness));
    }
}

// The other orders of the page, for albedos 0.5, 0.9 and 1 at once.
TEST(MediaSlab, HasTheOrdersOfOtherDepths) {
    constexpr Rgb albedos{0.5F, 0.9F, 1};
    const struct {
        double tau, g;
        double reflected[8], transmitted[8];  // along the normal
    } rows[] = {
        {1,
         0,
         {0, .14201535, .07888152, .04668661, .02832607, .01737144, .01070558, .00661283},
         {.36787944, .10617289, .06862215, .04360838, .02738659, .01708273, .01061660, .00658537}},
        {1,
         0.75,
         {0, .01656728, .01628177, .01389031, .01065968, .00755597, .00505921, .00326206},
         {.36787944, .30221870, .14599588, .05795476, .02297242, .01034617, .00544183, .00318172}},
        {5,
         0,
         {0, .15342484, .09726852, .06923070, .05267752, .04188238, .03435495, .02884459},
         {.00673795, .00507019, .00631455, .00747750, .00847372, .00926350, .00983580, .01019885}}};
    for (const auto& [tau, g, reflected, transmitted] : rows)
        for (const uint32_t depth : {1U, 2U, 4U, 7U}) {
            const Strictness strictness{.tests = 36, .truth_error = 1e-6};
            RenderSettings settings = square_settings("bsdf", along(1), 16, 256);
            settings.termination = {TerminationKind::depth, depth, 1};
            // after few scatterings the noise is most where most scatters, later where most is
            // absorbed
            const char* const noisiest = depth <= 2 && tau < 5 ? "B" : "R";
            const RenderResult result =
                render_for(strictness, slab(medium_of(tau, albedos, g)), settings, noisiest);
            for (std::size_t c = 0; c < 3; ++c) {
                double truth = 0;
                for (uint32_t k = 0; k <= depth; ++k)
                    truth += std::pow(double{albedos[c]}, k) * (reflected[k] + transmitted[k]);
                EXPECT_TRUE(has_mean(image_mean(result, channels[c]), truth, strictness))
                    << "tau " << tau << ", g " << g << ", depth " << depth << ", " << channels[c];
            }
        }
}

// The notes' uniform directions, whose weights have a relative variance of 7 at g = 0.75: one
// scattering.
TEST(MediaSlab, UniformDirectionsChangeNoMean) {
    constexpr double albedo = 0.9;
    const Strictness strictness{.bias = 0.01, .truth_error = 1e-6};
    RenderSettings settings = square_settings("path", along(1), 16, 256);
    settings.method.phase_directions = false;
    settings.termination = {TerminationKind::depth, 1, 1};
    const RenderResult result = render_for(strictness, slab(medium_of(1, albedo, 0.75)), settings);
    EXPECT_TRUE(
        has_mean(shared_mean(result), .36787944 + albedo * (.01656728 + .30221870), strictness));
}

}  // namespace
}  // namespace wavepath
