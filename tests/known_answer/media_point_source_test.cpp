// Sources within media: airlight of a point light, the fluence around a small source in an infinite
// medium, and the error's slope where its variance is infinite.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

PunctualLight point_light(const Vec3d& position) {
    PunctualLight light;
    light.position = position;
    return light;
}

// A ray passes the light at distance h, closest at s0, and ends at a black wall; single scattering:
// I sigma_s / (4 pi) A.
TEST(MediaPointSource, IsScatteredOnce) {
    constexpr struct {
        double sigma, h, s0, end, a;
    } cases[] = {{1, 0.5, 2, 4, .4013286272635}, {0.1, 1, 5, 10, 1.4294526901345}};
    for (const auto& c : cases) {
        Scene scene = scene_named("airlight");
        add_box(
            scene, boundary_of(medium_of(c.sigma, 1)), {-40, -40, -40}, {40, 40, 40},
            Facing::outward);
        add_square(scene, lambert(grey(0)), {0, 0, -c.end}, {0, 0, 1}, 1);
        scene.lights.push_back(point_light({c.h, 0, -c.s0}));
        RenderSettings settings =
            square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, 1e-4), 16, 512);
        settings.termination = {TerminationKind::depth, 1, 1};
        const Strictness strictness{.tests = std::size(cases), .truth_error = 1e-5};
        const RenderResult result = render_for(strictness, scene, settings);
        EXPECT_TRUE(
            has_mean(shared_mean(result), c.sigma / (4 * std::numbers::pi) * c.a, strictness))
            << "sigma " << c.sigma << ", h " << c.h;
    }
}

// Integral of radiance over one face of the cube around a camera, and its standard error.
Estimate face_of(const Scene& scene, const Vec3d& eye, const Vec3d& target, uint64_t samples) {
    RenderSettings settings =
        square_settings("path", perspective(eye, target, std::numbers::pi / 2), 64, samples);
    const RenderResult result = render_scene(scene, settings);
    const std::vector<float>& radiance = result.film.image.channels.at("R");
    const std::vector<float>& variance = result.film.image.channels.at("variance.R");
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        const auto from_middle = [](std::size_t k) { return (static_cast<double>(k) - 31.5) / 32; };
        const double x = from_middle(i % 64);
        const double y = from_middle(i / 64);
        const double solid_angle = std::pow(1 + x * x + y * y, -1.5) / (32 * 32);
        sum += solid_angle * radiance[i];
        squares += solid_angle * solid_angle * variance[i];
    }
    return {sum, std::sqrt(squares), 1000};
}

// Fluence at distance r from a source of unit power in an infinite isotropic medium of unit
// extinction. A camera does not meet a point: the source is a ball of radius `a` of the medium
// itself, which emits. By Fourier's inversion of Case's problem,
//     phi(r) = 1 / (2 pi^2 r) integral of k sin(k r) W(k a) A / (1 - albedo A) dk,   A = atan(k) /
//     k,
// W = 3 (sin x - x cos x) / x^3 for the ball.
void expect_fluence(double albedo, double a, double r, double truth, uint64_t samples) {
    Scene scene = scene_named("point source");
    add_box(
        scene, boundary_of(medium_of(1, albedo)), {-40, -40, -40}, {40, 40, 40}, Facing::outward);
    Medium emitting = medium_of(1, albedo);
    emitting.emission = grey(static_cast<float>(3 / (16 * std::pow(std::numbers::pi * a, 2) * a)));
    add_icosphere(scene, boundary_of(emitting), {0, 0, 0}, a, 4);
    const Vec3d eye{r, 0, 0};
    const Estimate ahead = face_of(scene, eye, {0, 0, 0}, samples);
    const Estimate aside = face_of(scene, eye, {r, 0, 1}, samples);
    const Estimate behind = face_of(scene, eye, {2 * r, 0, 0}, samples / 4);
    const Estimate fluence = {
        ahead.mean + 4 * aside.mean + behind.mean,
        std::sqrt(
            std::pow(ahead.error, 2) + std::pow(4 * aside.error, 2) + std::pow(behind.error, 2)),
        ahead.degrees};
    // faces are cut into pixels in which radiance and solid angle are taken for independent
    EXPECT_TRUE(has_mean(fluence, truth, {.truth_error = 5e-4}));
}

TEST(MediaPointSource, HasCasesFluence) {
    expect_fluence(0.5, 0.7, 1, .0699974, 320);
    expect_fluence(0.5, 0.35, 0.5, .336694, 320);
}

TEST(MediaPointSource, HasCasesFluenceAroundASmallSource_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_fluence(0.5, 0.4, 1, .0618109, 2048);
    expect_fluence(0.9, 0.5, 2, .0375179, 8192);
    expect_fluence(0.9, 0.35, 0.5, .523131, 640);
    expect_fluence(0.9, 0.5, 1, .148017, 2560);
    expect_fluence(0.99, 0.35, 0.5, .634247, 1536);
}

// A point light at a random stop's distance d counts as 1 / d^2, tail index 3/2: the error falls as
// N^(-1/3). Each of the 16 pixels has a light of its own.
TEST(MediaPointSource, SlopesAtRandomStops) {
    Scene scene = scene_named("lights in fog");
    add_box(scene, boundary_of(medium_of(1, 1)), {-1, -8, -2}, {1, 8, 0}, Facing::outward);
    for (int k = 0; k < 16; ++k) scene.lights.push_back(point_light({0, k - 7.5, -1}));
    RenderSettings settings =
        square_settings("direct", orthographic({0, 0, 1}, {0, 0, 0}, 1), 1, 1);
    settings.height = 16;
    settings.camera.y_mag = 8;
    settings.termination = {TerminationKind::depth, 1, 1};
    EXPECT_NEAR(error_slope(scene, settings, 256, 16384), -1.0 / 3, 0.1);
}

}  // namespace
}  // namespace wavepath
