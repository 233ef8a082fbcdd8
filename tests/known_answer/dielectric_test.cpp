// Smooth glass: a pane, an absorbing ball, a pane over a floor, a slab of a scattering medium, and
// n^2 inside.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

Material glass(double ior, const Medium& medium = {}) {
    Material material = boundary_of(medium);
    material.boundary = Boundary::dielectric;
    material.ior = static_cast<float>(ior);
    material.roughness = 0;
    return material;
}

Camera along(double mu) {
    const double sine = std::sqrt(1 - mu * mu);
    return orthographic({2 * sine, 0, 2 * mu}, {0, 0, 0}, 0.01);
}

Scene pane(const Material& material) {
    Scene scene = scene_named("pane");
    add_box(scene, material, {-40, -40, -1}, {40, 40, 0}, Facing::outward);
    return scene;
}

// By a tracer that averages polarisation at each interface: R = 2 R1 / (1 + R1) without absorption;
// sigma_a d = 0.5 along the normal. A black plane below hides what the pane transmits.
TEST(Dielectric, PaneReflectsAndTransmits) {
    // the few paths that come back are all the noise of what is reflected: 2 % will do
    constexpr double strict = 0.005;
    constexpr double lenient = 0.02;
    const struct {
        double mu, absorption;
        bool plane;
        double truth, bias;
    } cases[] = {
        {1, 0, true, .0769230769231, lenient},
        {0.5, 0, true, .1637675372900, lenient},
        {0.5, 0.5, true, .110977612649, lenient},
        {1, 0.5, false, .0535694948204 + .559307868577, strict},
        {0.5, 0.5, false, .110977612649 + .450738834233, strict}};
    for (const auto& c : cases) {
        SCOPED_TRACE(fmt::format("mu {}, absorption {}, plane {}", c.mu, c.absorption, c.plane));
        Scene scene = pane(glass(1.5, medium_of(c.absorption, 0)));
        scene.environment = constant_environment(1);
        if (c.plane) add_square(scene, lambert(grey(0)), {0, 0, -1.1}, {0, 0, 1}, 100);
        const Strictness strictness{.bias = c.bias, .tests = std::size(cases), .truth_error = 1e-6};
        const RenderSettings settings = square_settings("mis", along(c.mu), 32, 64);
        EXPECT_TRUE(
            has_mean(image_mean(render_for(strictness, scene, settings)), c.truth, strictness));
    }
}

// L = R + (1 - R)^2 t / (1 - R t) in a uniform environment, t along the chord inside; n = 1.5,
// sigma_a R = 0.25, through the centre.
TEST(Dielectric, BallAbsorbs) {
    Scene scene = scene_named("ball");
    scene.environment = constant_environment(1);
    constexpr int subdivisions = 5;
    add_icosphere(scene, glass(1.5, medium_of(0.25, 0)), {0, 0, 0}, 1, subdivisions);
    const Strictness strictness{.truth_error = icosphere_sagitta(subdivisions)};
    const RenderResult result = render_for(
        strictness, scene,
        square_settings("mis", orthographic({0, 0, 2}, {0, 0, 0}, 0.02), 32, 64));
    EXPECT_TRUE(has_mean(image_mean(result), .6128773634, strictness));
}

// A camera inside sees n^2 of the radiance outside, whatever way it looks.
TEST(Dielectric, RadianceInsideIsNSquared) {
    Scene scene = scene_named("inside");
    scene.environment = constant_environment(1);
    add_icosphere(scene, glass(1.5), {0, 0, 0}, 1, 3);
    const RenderResult result = render_for(
        {}, scene, square_settings("mis", perspective({0.1, 0, 0}, {1, 0.3, 0.2}, 1.2), 32, 64));
    EXPECT_TRUE(has_mean(image_mean(result), 2.25, {.truth_error = 1e-6}));
}

// Fresnel's 4 % and the medium behind: n = 1.5, albedo 0.9, isotropic, by adding-doubling.
TEST(Dielectric, SlabOfAScatteringMedium) {
    Scene scene = pane(glass(1.5, medium_of(1, 0.9)));
    scene.environment = constant_environment(1);
    const Strictness strictness{.tests = 2, .truth_error = 1e-6};
    EXPECT_TRUE(has_mean(
        image_mean(render_for(strictness, scene, square_settings("mis", along(1), 32, 64))),
        .221989919 + .505951304, strictness));
    EXPECT_TRUE(has_mean(
        image_mean(render_for(strictness, scene, square_settings("mis", along(0.5), 32, 64))),
        .286434242 + .421845674, strictness));
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
