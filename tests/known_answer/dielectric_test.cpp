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

// By a tracer that averages polarisation at each interface: R = 2 R1 / (1 + R1) without absorption.
TEST(Dielectric, PaneReflectsAndTransmits) {
    struct Case {
        double mu, clear, absorbing_r, absorbing_t;
    };
    constexpr Case cases[] = {
        {1, .0769230769231, .0535694948204, .559307868577},
        {0.5, .1637675372900, .110977612649, .450738834233}};
    for (const Case& c : cases) {
        // sigma_a d = 0.5 along the normal
        for (const bool absorbs : {false, true}) {
            SCOPED_TRACE(fmt::format("mu {}, absorbs {}", c.mu, absorbs));
            Scene scene = pane(glass(1.5, medium_of(absorbs ? 0.5 : 0, 0)));
            scene.environment = constant_environment(1);
            const Strictness strictness{.tests = 8, .truth_error = 1e-6};
            const RenderSettings settings = square_settings("mis", along(c.mu), 32, 64);
            const double both = absorbs ? c.absorbing_r + c.absorbing_t : 1;
            EXPECT_TRUE(
                has_mean(image_mean(render_for(strictness, scene, settings)), both, strictness));
            add_square(scene, lambert(grey(0)), {0, 0, -1.1}, {0, 0, 1}, 100);
            const double reflected = absorbs ? c.absorbing_r : c.clear;
            // the few paths that come back are all the noise: 2 % will do
            const Strictness lenient{.bias = 0.02, .tests = 8, .truth_error = 1e-6};
            EXPECT_TRUE(
                has_mean(image_mean(render_for(lenient, scene, settings)), reflected, lenient));
        }
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

}  // namespace
}  // namespace wavepath
