// Which triangles of a file bound a medium together, and faces that several bodies share.
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

double seen_from(const Scene& scene, const Vec3d& eye, const Vec3d& target) {
    const RenderResult result =
        render_scene(scene, square_settings("mis", orthographic(eye, target, 0.01), 4, 4));
    EXPECT_TRUE(result.warnings.empty());
    return shared_mean(result).mean;
}

// The scene's last primitive becomes part of the mesh of its first.
void join_last(Scene& scene) {
    scene.instances.back().body = scene.instances.front().body;
}

// A fog and the room around it, which glows, exported as one mesh: the room is no boundary, open or
// closed, whichever way its faces look, and whether the camera is in the fog or beside it.
TEST(MediaBody, IsNotTheRoomOfItsMesh) {
    for (const Facing facing : {Facing::inward, Facing::outward})
        for (const std::size_t left_open : {0U, 6U}) {
            Scene scene = scene_named("room");
            add_box(scene, boundary_of(medium_of(1, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
            Primitive& room =
                add_box(scene, lambert(grey(0), grey(1), true), {-2, -2, -2}, {2, 2, 2}, facing);
            room.indices.resize(room.indices.size() - left_open);
            scene.environment = constant_environment(1);
            join_last(scene);
            EXPECT_NEAR(seen_from(scene, {0.1, 0.2, 0}, {0.1, 0.2, 3}) / std::exp(-1), 1, 1e-5);
            EXPECT_EQ(seen_from(scene, {0.1, 0.2, 1.5}, {0.1, 0.2, 3}), 1);
        }
}

// An open piece of its mesh does not open a closed one, whichever way the closed room looks.
TEST(MediaBody, IsClosedBesideOpenPieces) {
    for (const Facing facing : {Facing::inward, Facing::outward}) {
        Scene scene = scene_named("pieces");
        const Material fog = boundary_of(medium_of(1, 0));
        add_box(scene, fog, {-1, -1, -1}, {1, 1, 1}, Facing::outward);
        add_box(scene, lambert(grey(0), grey(1), true), {-2, -2, -2}, {2, 2, 2}, facing);
        join_last(scene);
        add_square(scene, fog, {1.5, 0, 0}, {1, 0, 0}, 0.5);
        join_last(scene);
        const RenderResult result = render_scene(
            scene, square_settings("mis", orthographic({.1, .2, 0}, {.1, .2, 3}, 0.01), 4, 4));
        EXPECT_NEAR(shared_mean(result).mean / std::exp(-1), 1, 1e-5);
        ASSERT_EQ(result.warnings.size(), 1U);
        EXPECT_NE(result.warnings[0].find("not closed"), std::string::npos) << result.warnings[0];
    }
}

// Two fogs of one mesh that share a face and its corners are two bodies.
TEST(MediaBody, IsOneForEachMediumOfItsMesh) {
    Scene scene = scene_named("side by side");
    scene.environment = constant_environment(1);
    add_box(scene, boundary_of(medium_of(0.25, 0)), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    add_box(scene, boundary_of(medium_of(1, 0)), {-1, -1, 1}, {1, 1, 2}, Facing::outward);
    join_last(scene);
    EXPECT_NEAR(seen_from(scene, {.1, .2, 0}, {.1, .2, -3}) / std::exp(-.25), 1, 1e-5);
    EXPECT_NEAR(seen_from(scene, {.1, .2, 0}, {.1, .2, 3}) / std::exp(-.25 - 1), 1, 1e-5);
}

// Two shells of one mesh that cross: a camera in both has left both behind the second face, 2.5
// half-metres on. A small shell is inside a large one though a larger one lies far off.
TEST(MediaBody, IsEveryShellOfItsMesh) {
    Scene scene = scene_named("shells");
    scene.environment = constant_environment(1);
    const Material fog = boundary_of(medium_of(0.5, 0));
    add_box(scene, fog, {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    add_box(scene, fog, {-1, -1, -2}, {1, 1, 0}, Facing::outward);
    join_last(scene);
    EXPECT_NEAR(seen_from(scene, {.1, .2, -.5}, {.1, .2, 3}) / std::exp(-0.5 * 1.5), 1, 1e-5);
    EXPECT_NEAR(seen_from(scene, {.1, .2, -.5}, {.1, .2, -3}) / std::exp(-0.5 * 1.5), 1, 1e-5);

    Scene nested = scene_named("nested");
    nested.environment = constant_environment(1);
    const Material dense = boundary_of(medium_of(2, 0));
    add_box(nested, dense, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Facing::outward);
    add_box(nested, dense, {5, -3, -3}, {11, 3, 3}, Facing::outward);
    join_last(nested);
    add_box(nested, fog, {-1, -1, -1}, {1, 1, 1}, Facing::outward);
    EXPECT_NEAR(seen_from(nested, {.1, .2, 0}, {.1, .2, 3}) / std::exp(-2 * .5 - .5 * .5), 1, 1e-5);
}

// Three media of albedo 1 with faces in common planes, but for rounding: in a furnace nobody sees
// them, and no stop between two of these faces enters one of them twice.
TEST(MediaBody, MayShareItsFacesWithOthers) {
    Scene scene = scene_named("shared");
    scene.environment = constant_environment(1);
    const auto fog = [](double sigma_s) { return boundary_of(medium_of(sigma_s, 1)); };
    add_box(
        scene, fog(0.5), {-0.9999999, -0.9999999, -0.9999995}, {3e-7, 0.5, 1.0000005},
        Facing::outward);
    add_box(
        scene, fog(0.3), {-1.0000003, -0.9999999, -0.9999997}, {-3e-7, 2e-7, 1.0000002},
        Facing::outward);
    add_box(
        scene, fog(0.7), {-1.0000003, -0.9999999, -1}, {-5e-7, 0.4999995, 2e-7}, Facing::outward);
    const Camera camera = perspective({0.591, -3.318, -2.142}, {0, 0, 0}, 0.7);
    const Strictness strictness{.bias = .01, .tests = 3};
    for (const Distances distances :
         {Distances::exponential, Distances::uniform, Distances::truncated}) {
        RenderSettings settings = square_settings("direct", camera, 16, 64);
        settings.method.distances = distances;
        settings.split_depth = 1;
        const RenderResult result = render_for(strictness, scene, settings);
        EXPECT_EQ(result.film.nonfinite.samples, 0U);
        EXPECT_TRUE(has_mean(shared_mean(result), 1, strictness)) << static_cast<int>(distances);
    }
}

// A filter under a lamp, as close as rounding lets it be: what the lamp sends to a wall passes it,
// by light points as by chance.
TEST(MediaBoundary, TintsConnectionsJustBelowALamp) {
    for (const double below : {1e-6, 1e-4}) {
        Scene scene = scene_named("filter");
        add_square(scene, lambert(grey(0), grey(1)), {0, 0, 0}, {0, 0, -1}, 2);
        Material filter = boundary_of({});
        filter.base_color = grey(0.25F);
        add_box(scene, filter, {-1.2, -1.2, -below}, {1.2, 1.2, 1}, Facing::outward);
        add_square(scene, lambert(grey(0.5F)), {0, 0, -1}, {0, 0, 1}, 2);
        const Camera camera = close_up({0, 0, -1}, {0, 0, 1}, 0.1, 1e-3);
        const Strictness strictness{.tests = 4};
        const auto mean = [&](const char* method) {
            return shared_mean(render_for(
                {.bias = .0035, .tests = 4}, scene, square_settings(method, camera, 16, 64)));
        };
        const Estimate by_chance = mean("path");
        EXPECT_TRUE(agree(mean("mis"), by_chance, strictness)) << below;
        EXPECT_TRUE(agree(mean("direct"), by_chance, strictness)) << below;
    }
}

}  // namespace
}  // namespace wavepath
