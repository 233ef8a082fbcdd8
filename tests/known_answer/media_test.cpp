// What holds for media of any shape: furnaces, isothermal enclosures, spheres, light from inside,
// and boundaries that must not be there.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

// Albedo 1 in an enclosure of one radiance: nobody can see that the medium is there.
TEST(Media, ThatOnlyScattersIsInvisibleInAFurnace) {
    const Camera outside = perspective({0.2, 0.1, 1.6}, {0, 0, 0}, 0.9);
    const Camera inside = perspective({0.1, 0.05, 0.2}, {-1, -0.4, -0.9}, 1.6);
    const struct {
        double g;
        const Camera& camera;
        const char* method;
    } cases[] = {{0, outside, "path"}, {0.9, inside, "mis"}, {-0.9999, outside, "mis"}};
    for (const auto& [g, camera, method] : cases) {
        Scene scene = scene_named("furnace");
        add_box(scene, lambert(grey(0), grey(1)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
        add_icosphere(scene, boundary_of(medium_of(4, 1, g)), {0, 0, 0}, 1, 2);
        const Strictness strictness{.tests = std::size(cases)};
        const RenderResult result =
            render_for(strictness, scene, square_settings(method, camera, 32, 64));
        EXPECT_TRUE(has_mean(shared_mean(result), 1, strictness)) << method << ", g " << g;
    }
}

// Medium and walls at one temperature: walls emit (1 - rho) B, the medium sigma_a B.
TEST(Media, AtOneTemperatureIsInvisible) {
    for (const double g : {0.0, 0.75}) {
        Medium medium = medium_of(3, 0.6, g);
        medium.emission = medium.sigma_a;
        Scene scene = scene_named("isothermal");
        add_box(scene, lambert(grey(0.5F), grey(0.5F)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
        add_box(scene, boundary_of(medium), {-1, -0.5, -1}, {1, 0.7, 1}, Facing::outward);
        for (const char* method : {"path", "mis"}) {
            const RenderResult result = render_for(
                {.tests = 4}, scene,
                square_settings(method, perspective({1.7, 1, 1.6}, {0, 0, 0}, 0.9), 32, 64));
            EXPECT_TRUE(has_mean(image_mean(result), 1, {.tests = 4})) << method << ", g " << g;
        }
    }
}

// Chord of a sphere, averaged over its disc: 2 [1 - (1 + t) e^-t] / t^2, t = 2 sigma_a R. And from
// its centre: e^-t/2 everywhere.
TEST(MediaSphere, Absorbs) {
    constexpr int subdivisions = 5;
    for (const double t : {0.1, 1.0, 10.0}) {
        Scene scene = scene_named("sphere");
        scene.environment = constant_environment(1);
        add_icosphere(scene, boundary_of(medium_of(t / 2, 0)), {0, 0, 0}, 1, subdivisions);
        const double truth_error = (1 + t) * 2 * icosphere_sagitta(subdivisions);
        const RenderResult centre = render_scene(
            scene, square_settings("mis", perspective({0, 0, 0}, {1, 0.3, 0.2}, 1.5), 16, 4));
        EXPECT_NEAR(shared_mean(centre).mean / std::exp(-t / 2), 1, truth_error) << t;
        // the square around the disc sees the sky, 1, in its corners
        const RenderResult disc = render_for(
            {.tests = 3}, scene,
            square_settings("mis", orthographic({0, 0, 2}, {0, 0, 0}, 2), 64, 64));
        const double chord = 2 * (1 - (1 + t) * std::exp(-t)) / (t * t);
        const double share = std::numbers::pi / 4;
        EXPECT_TRUE(has_mean(
            image_mean(disc), share * chord + 1 - share, {.tests = 3, .truth_error = truth_error}))
            << t;
    }
}

// A ball of medium in a uniform environment, by its own integral equation.
TEST(MediaSphere, ShinesByItsIntegralEquation) {
    constexpr int subdivisions = 5;
    // through the centre from outside; and from the centre, any way: the medium is isotropic
    const struct {
        double tau, albedo;
        const char* method;
        Camera camera;
        double truth;
    } cases[] = {
        {1, 0.9, "mis", orthographic({0, 0, 2}, {0, 0, 0}, 1e-2), .835122040},
        {2, 0.5, "direct", perspective({0, 0, 0}, {1, 0.3, 0.2}, 1), .281549103}};
    for (const auto& c : cases) {
        Scene scene = scene_named("sphere");
        scene.environment = constant_environment(1);
        add_icosphere(scene, boundary_of(medium_of(c.tau, c.albedo)), {0, 0, 0}, 1, subdivisions);
        const Strictness strictness{
            .tests = std::size(cases), .truth_error = 2 * c.tau * icosphere_sagitta(subdivisions)};
        const RenderResult result =
            render_for(strictness, scene, square_settings(c.method, c.camera, 32, 64));
        EXPECT_TRUE(has_mean(shared_mean(result), c.truth, strictness)) << c.tau;
    }
}

// Airlight: a point light in a medium, seen by a ray that passes it at distance h, closest at s0,
// and ends at a black wall; single scattering: I sigma_s / (4 pi) A.
TEST(Media, ScattersAPointLightOnce) {
    struct Case {
        double sigma, h, s0, end, a;
    };
    constexpr Case cases[] = {{1, 0.5, 2, 4, .4013286272635}, {0.1, 1, 5, 10, 1.4294526901345}};
    for (const Case& c : cases) {
        Scene scene = scene_named("airlight");
        add_box(
            scene, boundary_of(medium_of(c.sigma, 1)), {-40, -40, -40}, {40, 40, 40},
            Facing::outward);
        add_square(scene, lambert(grey(0)), {0, 0, -c.end}, {0, 0, 1}, 1);
        PunctualLight light;
        light.position = {c.h, 0, -c.s0};
        scene.lights.push_back(light);
        RenderSettings settings =
            square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, 1e-4), 32, 256);
        settings.termination = {TerminationKind::depth, 1, 1};
        const RenderResult result = render_for({.tests = 2}, scene, settings);
        EXPECT_TRUE(has_mean(
            shared_mean(result), c.sigma / (4 * std::numbers::pi) * c.a,
            {.tests = 2, .truth_error = 1e-5}))
            << c.sigma;
    }
}

// A floor under a square light; F = .2394564704607735 at the origin. Boundaries around nothing, put
// where shadow rays find it hard, change no bit.
TEST(MediaBoundary, AroundNothingIsNotThere) {
    constexpr double near = 1e-4;
    const struct {
        const char* what;
        Vec3d low, high;
    } cases[] = {
        {"between", {-3, -3, 0.3}, {3, 3, 0.7}},
        {"below the lamp", {-3, -3, 0.2}, {3, 3, 1 - near}},
        {"around all but the camera", {-3, -3, -1}, {3, 3, 1.5}},
        {"through floor and lamp", {-0.2, -0.3, -1}, {0.25, 0.35, 1.5}},
        {"above the floor", {-3, -3, near}, {3, 3, 0.5}},
        {"in the plane of the floor", {-3, -3, 0}, {3, 3, 0.5}},
    };
    // of one extent and with the same features: the same numbers are drawn
    const auto with_boundary = [](const Vec3d& low, const Vec3d& high) {
        Scene scene = scene_named("floor and light");
        add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.1);
        add_square(scene, lambert(grey(0), grey(1), true), {0, 0, 1}, {0, 0, -1}, 1);
        add_box(scene, lambert(grey(0)), {-3, -3, -1}, {-2.9, -2.9, -0.9}, Facing::outward);
        add_box(scene, lambert(grey(0)), {2.9, 2.9, 1.4}, {3, 3, 1.5}, Facing::outward);
        add_box(scene, boundary_of({}), low, high, Facing::outward);
        return scene;
    };
    const Scene aside = with_boundary({-2, -2, -0.9}, {-1.9, -1.9, -0.8});
    for (const char* method : {"bsdf", "direct", "mis"}) {
        const RenderSettings settings =
            square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 16, 64);
        const RenderResult truth = render_scene(aside, settings);
        for (const auto& [what, low, high] : cases) {
            SCOPED_TRACE(fmt::format("{}, {}", what, method));
            const RenderResult result = render_scene(with_boundary(low, high), settings);
            const auto& expected = truth.film.image.channels.at("R");
            for (std::size_t i = 0; i < expected.size(); ++i)
                ASSERT_EQ(result.film.image.channels.at("R")[i], expected[i]) << i;
        }
    }
    const RenderResult lit = render_for(
        {}, aside, square_settings("mis", close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 16, 256));
    EXPECT_TRUE(has_mean(shared_mean(lit), .2394564704607735, {.truth_error = 1e-5}));
}

// A furnace whose wall stands behind eight boundaries: they spend neither depth nor chances of
// survival.
TEST(MediaBoundary, IsNoScattering) {
    Scene scene = scene_named("shells");
    add_box(scene, lambert(grey(0.5F), grey(1)), {-2, -2, -2}, {2, 2, 2}, Facing::inward);
    for (const double half : {1.9, 1.5, 1.0, 0.5})
        add_box(scene, boundary_of({}), {-half, -half, -half}, {half, half, half}, Facing::outward);
    RenderSettings settings =
        square_settings("path", perspective({0.1, 0, 0.2}, {-1, -0.4, -0.9}, 1.2), 32, 4);
    settings.termination = {TerminationKind::depth, 2, 1};
    EXPECT_NEAR(shared_mean(render_scene(scene, settings)).mean, 1.75, 1e-6);
    settings.termination = {TerminationKind::roulette_constant, 0, 0.8F};
    settings.samples = 64;
    EXPECT_TRUE(has_mean(image_mean(render_for({}, scene, settings)), 2));
}

// Two balls in one another: the medium entered last fills the space. Chords along a diameter.
TEST(MediaBoundary, InnermostMediumWins) {
    Scene scene = scene_named("nested");
    scene.environment = constant_environment(1);
    const auto absorbing = [](double sigma) { return boundary_of(medium_of(sigma, 0)); };
    add_box(scene, absorbing(0.5), {-2, -2, -2}, {2, 2, 2}, Facing::outward);
    add_box(scene, absorbing(2), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    add_box(scene, boundary_of({}), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Facing::outward);
    const auto radiance = [&](const Camera& camera) {
        return shared_mean(render_scene(scene, square_settings("mis", camera, 8, 4))).mean;
    };
    EXPECT_NEAR(
        radiance(orthographic({0.1, 0.1, 5}, {0.1, 0.1, 0}, 0.1)) / std::exp(-2 * 0.5 - 2), 1,
        1e-5);
    // from the bubble, and from the shell around it
    EXPECT_NEAR(
        radiance(orthographic({0, 0, 0.1}, {0, 0, 1}, 0.1)) / std::exp(-0.5 * 2 - 0.5), 1, 1e-5);
    EXPECT_NEAR(
        radiance(orthographic({0, 0, 0.75}, {0, 0, 1}, 0.1)) / std::exp(-0.25 * 2 - 0.5), 1, 1e-5);
}

TEST(MediaBoundary, ThatAnOrthographicCameraCutsIsRefused) {
    Scene scene = scene_named("cut");
    scene.environment = constant_environment(1);
    add_box(scene, boundary_of(medium_of(1, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    EXPECT_THROW(
        render(
            test_device(), scene,
            square_settings("mis", orthographic({0, 0, 0}, {0, 0, -1}, 3), 8, 4)),
        Error);
}

}  // namespace
}  // namespace wavepath
