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

struct PlaneAlbedo {
    double mu;
    double truth[3];
};

// 1 - sqrt(1 - albedo) H(mu): what is seen under a uniform sky, by reciprocity.
void expect_plane_albedos(const std::vector<PlaneAlbedo>& cases) {
    Scene scene = half_space();
    scene.environment = constant_environment(1);
    const Strictness strictness{.tests = 3 * cases.size()};
    for (const auto& [mu, truth] : cases) {
        const RenderResult result =
            render_for(strictness, scene, square_settings("path", along(mu), 16, 256));
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
                << "albedo " << albedos[c] << ", mu " << mu;
    }
}

TEST(MediaHalfSpace, ReflectsByTheHFunction) {
    expect_plane_albedos({{0.1, {.0395738076, .2417207764, .6293358207}}});
}

// Towards the normal little comes back, from few paths.
TEST(MediaHalfSpace, ReflectsByTheHFunctionTowardsTheNormal_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_plane_albedos(
        {{1, {.0163903422, .1152258777, .4149474791}},
         {0.5, {.0238785634, .1601444334, .5079389069}}});
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
