// A half-space of an isotropic medium: Chandrasekhar's H functions (Radiative Transfer, 1960), with
// three albedos at once. A plate of optical thickness 40 transmits less than 10^-8 of albedo 0.9.
#include "support/media.h"
#include "support/rendering.h"

#include <numbers>

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};
constexpr Rgb albedos{0.1F, 0.5F, 0.9F};

Scene half_space() {
    Scene scene = scene_named("half-space");
    add_slab(scene, medium_of(40, albedos), 1);
    return scene;
}

// 1 - sqrt(1 - albedo) H(mu): what is seen under a uniform sky, by reciprocity. Towards the normal
// little comes back of albedo 0.1, from few paths: taking what leaves along each of two segments
// quarters the samples.
TEST(MediaHalfSpace, ReflectsByTheHFunction) {
    const struct {
        double mu;
        double truth[3];
    } cases[] = {
        {0.1, {.0395738076, .2417207764, .6293358207}},
        {0.25, {.0314014318, .2012146372, .5752204677}},
        {0.5, {.0238785634, .1601444334, .5079389069}},
        {0.75, {.0194075897, .1338418106, .4564042934}},
        {1, {.0163903422, .1152258777, .4149474791}}};
    Scene scene = half_space();
    scene.environment = constant_environment(1);
    const Strictness strictness{.tests = 3 * std::size(cases)};
    for (const auto& [mu, truth] : cases) {
        RenderSettings settings = square_settings("path", along(mu), 16, 256);
        settings.method.distances = Distances::truncated;
        settings.split_depth = 2;
        const RenderResult result = render_for(strictness, scene, settings);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
                << "albedo " << albedos[c] << ", mu " << mu;
    }
}

// Albedo 0.99: between mirrors, for light goes far, and so thick that it lets 10^-8 through.
TEST(MediaHalfSpace, ReflectsByTheHFunctionWithLittleAbsorption) {
    const struct {
        double mu, truth;
    } cases[] = {
        {0.1, .8775124710},
        {0.25, .8519257394},
        {0.5, .8151398984},
        {0.75, .7824605770},
        {1, .7527207172}};
    Scene scene = scene_named("half-space");
    scene.environment = constant_environment(1);
    add_mirrored_slab(scene, medium_of(100, 0.99));
    const Strictness strictness{.tests = std::size(cases)};
    for (const auto& [mu, truth] : cases)
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, scene, square_settings("path", along(mu), 32, 64))),
            truth, strictness))
            << "mu " << mu;
}

// From the sun to the eye, albedo / (4 pi) mu0 / (mu + mu0) H(mu) H(mu0) a unit of irradiance
// normal to the beam; and the other way round.
TEST(MediaHalfSpace, ReflectsTheSunByReciprocity) {
    constexpr double h_half[] = {1.0289223375, 1.1877351327, 1.5560338020};
    constexpr double h_one[] = {1.0368156158, 1.2512595634, 1.8500985168};
    // albedo 0.9 takes the most samples: 1 % will do there
    const Strictness strictness[] = {{.tests = 6}, {.tests = 6}, {.bias = 0.01, .tests = 6}};
    for (const auto& [mu0, mu] : {std::pair{0.5, 1.0}, std::pair{1.0, 0.5}}) {
        Scene scene = half_space();
        PunctualLight sun;
        sun.kind = LightKind::directional;
        sun.direction = {-std::sqrt(1 - mu0 * mu0), 0, -mu0};
        scene.lights.push_back(sun);
        const RenderResult result =
            render_for(strictness[2], scene, square_settings("direct", along(mu), 16, 256), "B");
        for (std::size_t c = 0; c < 3; ++c) {
            const double truth = double{albedos[c]} / (4 * std::numbers::pi) * mu0 / (mu + mu0) *
                                 h_half[c] * h_one[c];
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth, strictness[c]))
                << "albedo " << albedos[c] << ", sun " << mu0 << ", eye " << mu;
        }
    }
}

}  // namespace
}  // namespace wavepath
