// What touches a thin wall (KHR_materials_transmission without a volume).
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

constexpr double gap = 2e-6;  // [m] 6 10^-6 touches

Material wall(float roughness) {
    Material material = dielectric(grey(1), roughness);
    material.transmission = 1;
    return material;
}

// A window in the plane of a fog's face, before something white-hot: the same as a window that
// stands a little off, seen through the window and mirrored in it from within the fog; of one mesh
// with the fog, too.
TEST(ContactOfWalls, WindowThatClosesOffFog) {
    for (const bool mirrored : {false, true}) {
        // 4 % are mirrored, which is so much noisier
        const double bias = mirrored ? .05 : .015;
        const Strictness strictness{.bias = bias, .tests = 48};
        for (const float roughness : {0.0F, 0.4F}) {
            const auto mean = [&](double off, bool window_first, bool joined, const char* method) {
                Scene scene = scene_named("window");
                add_square(scene, lambert(grey(0), grey(1)), {0, 0, -2}, {0, 0, 1}, 8);
                const auto add_window = [&] {
                    add_square(scene, wall(roughness), {0, 0, off}, {0, 0, 1}, 6);
                };
                if (window_first) add_window();
                add_box(
                    scene, boundary_of(medium_of(0.5, 0)), {-1, -1, -1}, {1, 1, 0},
                    Facing::outward);
                if (!window_first) add_window();
                if (joined) scene.instances[1].body = scene.instances[2].body;
                const Vec3d eye{0.1, 0.2, mirrored ? -0.5 : 1};
                const RenderSettings settings =
                    square_settings(method, orthographic(eye, {0.1, 0.2, 0}, 0.1), 16, 64);
                return shared_mean(render_for({.bias = bias / 1.5, .tests = 48}, scene, settings));
            };
            const Estimate apart = mean(1e-3, true, false, "bsdf");
            for (const double off : {0.0, gap, -gap})
                for (const bool first : {true, false})
                    for (const bool joined : {true, false})
                        EXPECT_TRUE(agree(mean(off, first, joined, "mis"), apart, strictness))
                            << mirrored << ", " << roughness << ", off " << off << ", window first "
                            << first << ", one mesh " << joined;
        }
    }
}

// On what is opaque a wall is not there, and lets nothing through to what lies below.
TEST(ContactOfWalls, WallOnAFloor) {
    for (const double off : {0.0, gap, -gap})
        for (const bool floor_first : {true, false}) {
            Scene scene = scene_named("floor");
            scene.environment = constant_environment(1);
            const auto add_floor = [&] {
                add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 6);
            };
            if (floor_first) add_floor();
            add_square(scene, wall(0), {0, 0, off}, {0, 0, 1}, 6);
            if (!floor_first) add_floor();
            const RenderResult result = render_scene(
                scene,
                square_settings("mis", orthographic({0.1, 0.2, 1}, {0.1, 0.2, 0}, 0.1), 8, 64));
            EXPECT_NEAR(shared_mean(result).mean, 0.5, 1e-6) << off << ", " << floor_first;
        }
}

// On glass it is not there either: the furnace shows nothing, of the glass or within it.
TEST(ContactOfWalls, WallOnGlass) {
    for (const double off : {0.0, gap, -gap})
        for (const bool wall_first : {true, false}) {
            Scene scene = scene_named("glass");
            scene.environment = constant_environment(1);
            const auto add_wall = [&] { add_square(scene, wall(0), {0, 0, off}, {0, 0, 1}, 1.5); };
            if (wall_first) add_wall();
            add_box(scene, glass(1.5), {-1, -1, -1}, {1, 1, 0}, Facing::outward);
            if (!wall_first) add_wall();
            const auto seen = [&](const Vec3d& eye, const Vec3d& target) {
                return shared_mean(render_scene(
                                       scene, square_settings(
                                                  "mis", orthographic(eye, target, 0.1), 8, 64)))
                    .mean;
            };
            EXPECT_NEAR(seen({0.1, 0.2, 1}, {0.15, 0.1, 0}), 1, 1e-5) << off << ", " << wall_first;
            EXPECT_NEAR(seen({0.1, 0.2, -.5}, {0.15, 0.1, 0}), 2.25, 3e-5)
                << off << ", " << wall_first;
        }
}

// From far off, too: fog on a floor and behind a window shows what it does from close by, and depth
// is that of the floor.
TEST(ContactOfWalls, OfFogAreSeenFromFarOff) {
    for (const bool has_window : {false, true}) {
        Scene scene = scene_named("far");
        scene.environment = constant_environment(1);
        add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 4);
        add_box(scene, boundary_of(medium_of(0.5, 0)), {-1, -1, 0}, {1, 1, 1}, Facing::outward);
        if (has_window) add_square(scene, wall(0), {0, 0, 1}, {0, 0, 1}, 1.5);
        const Strictness strictness{.tests = 8};
        const auto seen = [&](double off, bool has_film) {
            const Vec3d eye{0.1 + 0.3 * off, 0.2 + 0.2 * off, off};
            const Camera camera = has_film ? orthographic(eye, {0.1, 0.2, 0}, 0.1)
                                           : perspective(eye, {0.1, 0.2, 0}, 0.1 / off);
            return render_for(
                {.bias = .0035, .tests = 8}, scene, square_settings("mis", camera, 16, 64));
        };
        const Estimate close = image_mean(seen(3, true));
        for (const double off : {30., 400.})
            for (const bool has_film : {false, true}) {
                const RenderResult result = seen(off, has_film);
                EXPECT_TRUE(agree(image_mean(result), close, strictness))
                    << off << ", window " << has_window << ", film " << has_film;
                const double depth = off * std::sqrt(1 + 0.3 * 0.3 + 0.2 * 0.2);
                if (!has_window) {
                    EXPECT_NEAR(result.film.image.channels.at("depth.Z")[0] / depth, 1, 0.01);
                }
            }
    }
}

// A glass and the floor it stands on in one mesh touch as two meshes do, of the same corners too.
TEST(Contact, OfOneMesh) {
    for (const auto& [facing, side] : {std::pair{1, 1000}, {-1, 1000}, {1, 800}, {-1, 800}}) {
        Scene scene = scene_named("one mesh");
        scene.environment = constant_environment(1);
        add_box(scene, glass(1.5), {-400, -400, 0}, {400, 400, 1}, Facing::outward);
        add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1. * facing}, side);
        scene.instances[1].body = scene.instances[0].body;
        constexpr double inside = .5963457597;  // Saunderson, as Contact.PaneOnAFloor
        constexpr double truth = .04 + .96 * .5 * (1 - inside) / (1 - .5 * inside);
        const Strictness strictness{.tests = 4, .truth_error = 1e-6};
        const RenderResult result = render_for(
            strictness, scene,
            square_settings("mis", orthographic({0.1, 0.03, 2}, {0.1, 0.03, 0}, .01), 16, 64));
        EXPECT_TRUE(has_mean(shared_mean(result), truth, strictness)) << facing << ", " << side;
    }
}

}  // namespace
}  // namespace wavepath
