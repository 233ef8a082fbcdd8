// Phase functions, each medium's own, and the densities of the directions that are drawn: by the
// phase function, uniform, or aimed at a lamp, weighed against light points.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

// Henyey and Greenstein's, of the angle between directions of travel.
double phase(double g, double cosine) {
    return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

// Two plates on one another under a sun, single scattering: of each
//     albedo p mu0 / (mu + mu0) (1 - exp(-tau m)),   m = 1 / mu + 1 / mu0,
// behind exp(-m) a unit of tau above it. Their phase functions differ.
TEST(MediaPhase, OfTwoPlatesUnderASun) {
    constexpr double mu = 0.5;
    constexpr double mu0 = 1;
    constexpr double m = 1 / mu + 1 / mu0;
    const struct { double tau, albedo, g; } upper{0.3, 0.5, 0.6}, lower{0.7, 0.9, -0.5};
    Scene scene = scene_named("two plates");
    const auto add_plate = [&](const auto& plate, double low, double high) {
        add_box(
            scene, boundary_of(medium_of(plate.tau / (high - low), plate.albedo, plate.g)),
            {-40, -40, low}, {40, 40, high}, Facing::outward);
    };
    add_plate(upper, -0.4, 0);
    add_plate(lower, -1, -0.5);
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.direction = {0, 0, -1};
    scene.lights.push_back(sun);
    const auto scattered = [&](const auto& plate) {
        return plate.albedo * phase(plate.g, -mu) * mu0 / (mu + mu0) *
               (1 - std::exp(-plate.tau * m));
    };
    const double truth = scattered(upper) + std::exp(-upper.tau * m) * scattered(lower);
    const Strictness strictness{.tests = 2, .truth_error = 1e-6};
    for (const char* method : {"direct", "mis"}) {
        RenderSettings settings = square_settings(method, along(mu), 16, 256);
        settings.termination = {TerminationKind::depth, 1, 1};
        EXPECT_TRUE(
            has_mean(shared_mean(render_for(strictness, scene, settings)), truth, strictness))
            << method;
    }
}

// MCML's plate between mirrors (`MediaSlab.ReflectsAndTransmitsAsVanDeHulstSays`), second in a file
// whose first medium, hidden below the floor, scatters in another way.
TEST(MediaPhase, OfAPlateIsItsOwn) {
    Scene scene = scene_named("MCML");
    add_box(
        scene, boundary_of(medium_of(1, 1)), {-0.5, -0.5, -2}, {0.5, 0.5, -1.5}, Facing::outward);
    add_box(
        scene, boundary_of(medium_of(2, 0.9, 0.75)), {-0.5, -0.5, -1}, {0.5, 0.5, 0},
        Facing::outward);
    split_off(scene, 12, metal(grey(1), 0));
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, -1.0001}, {0, 0, 1}, 3);
    const Strictness strictness{.truth_error = 2e-7};
    EXPECT_TRUE(has_mean(
        shared_mean(render_for(strictness, scene, square_settings("bsdf", along(1), 32, 64))),
        .6609577002, strictness));
}

// Medium and walls of one temperature, all around in radiance 1, in which directions are uniform
// and the phase function is not. Every wall is a lamp.
TEST(MediaPhase, OfUniformDirectionsIsInvisibleAtOneTemperature) {
    Medium medium = medium_of(1, 0.8, 0.5);
    medium.emission = medium.sigma_a;
    Scene scene = scene_named("isothermal");
    add_box(scene, lambert(grey(0.5F), grey(0.5F)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
    add_box(scene, boundary_of(medium), {-1, -0.5, -1}, {1, 0.7, 1}, Facing::outward);
    RenderSettings settings =
        square_settings("mis", perspective({1.7, 1, 1.6}, {0, 0, 0}, 0.6), 32, 64);
    settings.method.phase_directions = false;
    EXPECT_TRUE(has_mean(image_mean(render_for({}, scene, settings)), 1));
}

// A square lamp of half a metre shines down on a ray that leaves half a metre below it, into fog
// that throws its light back, and ends at a black wall; single scattering by quadrature. Another
// lamp on its back takes nine tenths of the light points, so that directions, aimed or not, count
// as much.
TEST(MediaPhase, OfAirlightOfALampHasOneMeanByAllDirections) {
    constexpr double truth = .010338073016;
    Scene scene = scene_named("lamp in fog");
    add_box(scene, boundary_of(medium_of(0.5, 1, -0.6)), {-3, -3, -3}, {3, 3, 3}, Facing::outward);
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 0.5}, {0, 0, -1}, 0.5);
    add_square(scene, lambert(grey(0), grey(9)), {0, 0, 0.51}, {0, 0, 1}, 0.5);
    add_square(scene, lambert(grey(0)), {0.1, 1.7, 0}, {0, -1, 0}, 0.5);
    const struct { bool guide, phase; } ways[] = {{true, true}, {true, false}, {false, false}};
    // most light points and most directions see nothing: .5 % would take four times as long
    const Strictness strictness{.bias = 0.01, .tests = std::size(ways), .truth_error = 1e-6};
    for (const auto& way : ways) {
        RenderSettings settings =
            square_settings("mis", orthographic({0.1, 0.2, 0}, {0.1, 1, 0}, 1e-4), 16, 1024);
        settings.termination = {TerminationKind::depth, 1, 1};
        settings.method.distances = Distances::equiangular;
        settings.method.guide = way.guide;
        settings.method.phase_directions = way.phase;
        const RenderResult result = render_for(strictness, scene, settings);
        EXPECT_EQ(result.guided, way.guide);
        EXPECT_TRUE(has_mean(shared_mean(result), truth, strictness))
            << "guide " << way.guide << ", phase " << way.phase;
    }
}

}  // namespace
}  // namespace wavepath
