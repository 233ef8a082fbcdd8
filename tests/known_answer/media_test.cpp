// What holds for media of any shape: furnaces, isothermal enclosures, mean chords, and boundaries
// that must not be there.
#include "support/media.h"
#include "scene/transform.h"
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

// Boxes of 1 x 1/2 x 1/4 in cells of black walls, each turned its own way: a square view straight
// down sees them from directions spread evenly over a half-sphere (Fibonacci's spiral).
Scene turned_boxes(const Medium& medium, int rows, double cell) {
    Scene scene = scene_named("turned boxes");
    add_box(scene, boundary_of(medium), {-0.5, -0.25, -0.125}, {0.5, 0.25, 0.125}, Facing::outward);
    scene.instances.clear();
    const auto middle = [&](int k) { return (k - 0.5 * (rows - 1)) * cell; };
    const int boxes = rows * rows;
    for (int k = 0; k < boxes; ++k) {
        const double z = (k + 0.5) / boxes;
        const double turn = 2 * std::numbers::pi * k / std::numbers::phi;
        const double sine = std::sqrt(1 - z * z);
        // the box's own direction that is turned up, and two across
        const Vec3d up{sine * std::cos(turn), sine * std::sin(turn), z};
        const Vec3d u = normalized(cross({-std::sin(turn), std::cos(turn), 0}, up));
        const Vec3d v = cross(up, u);
        Matrix4 to_world = identity_matrix;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            to_world[4 * axis] = u[axis];
            to_world[4 * axis + 1] = v[axis];
            to_world[4 * axis + 2] = up[axis];
        }
        to_world[12] = middle(k % rows);
        to_world[13] = middle(k / rows);
        scene.instances.push_back({0, to_world, static_cast<uint32_t>(k)});
    }
    const double side = rows * cell;
    for (int k = 0; k <= rows; ++k) {
        const double x = middle(k) - 0.5 * cell;
        add_square(scene, lambert(grey(0)), {x, 0, 0}, {1, 0, 0}, side);
        add_square(scene, lambert(grey(0)), {0, x, 0}, {0, 1, 0}, side);
    }
    return scene;
}

// Rays that enter evenly over a body's surface S and by the cosine stay in it for 4 V / S on the
// mean, however it scatters, where nothing is absorbed [Blanco & Fournier 2003]. A medium that
// emits 1 a metre shows how long they stayed: integrated over a view and averaged over views, V.
TEST(Media, HasCauchysMeanChord) {
    const auto emitting = [](double sigma_s, double g) {
        Medium medium = medium_of(sigma_s, 1, g);
        medium.emission = grey(1);
        return medium;
    };
    constexpr int subdivisions = 5;
    Scene ball = scene_named("ball");
    add_icosphere(ball, boundary_of(emitting(3, 0.99)), {0, 0, 0}, 1, subdivisions);
    // a ball looks the same from everywhere
    const Strictness strictness{.tests = 2, .truth_error = icosphere_sagitta(subdivisions)};
    EXPECT_TRUE(has_mean(
        image_mean(render_for(
            strictness, ball,
            square_settings("path", orthographic({0, 0, 2}, {0, 0, 0}, 2.01), 64, 64))),
        4 * std::numbers::pi / 3 / (2.01 * 2.01), strictness));
    constexpr int rows = 16;
    constexpr double cell = 1.15;
    const Strictness of_boxes{.bias = 0.01, .tests = 2, .truth_error = 2e-4};
    EXPECT_TRUE(has_mean(
        image_mean(render_for(
            of_boxes, turned_boxes(emitting(4, -0.9), rows, cell),
            square_settings("path", orthographic({0, 0, 20}, {0, 0, 0}, rows * cell), 128, 64))),
        0.125 / (cell * cell), of_boxes));
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
        {"around all, the camera too", {-3, -3, -1}, {3, 3, 1.5}},
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

TEST(MediaBoundary, AroundWhatIsDenserThanFloatsTellApartIsRefused) {
    Scene scene = scene_named("ball");
    scene.environment = constant_environment(1);
    add_icosphere(scene, boundary_of(medium_of(1e8, 0.9)), {0, 0, 0}, 1, 1);
    const RenderSettings settings =
        square_settings("mis", perspective({0, 0, 3}, {0, 0, 0}, 1), 2, 1);
    EXPECT_THROW(render(test_device(), scene, settings), Error);
    scene.materials[0].medium = medium_of(1e8, 0);  // absorbs at once
    EXPECT_NO_THROW(render(test_device(), scene, settings));
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
