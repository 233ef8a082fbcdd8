// What holds for media of any shape: furnaces, isothermal enclosures, mean chords.
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
    const Strictness of_boxes{.tests = 2, .truth_error = 2e-4};
    EXPECT_TRUE(has_mean(
        image_mean(render_for(
            of_boxes, turned_boxes(emitting(4, -0.9), rows, cell),
            square_settings("path", orthographic({0, 0, 20}, {0, 0, 0}, rows * cell), 128, 64))),
        0.125 / (cell * cell), of_boxes));
}

}  // namespace
}  // namespace wavepath
