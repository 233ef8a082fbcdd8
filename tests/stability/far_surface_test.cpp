// Light to and from what lies far off, in a picture of something close.
#include "support/media.h"
#include "support/rendering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

// Something small and black in the lower left of the views of this file, about which the scene is
// laid; beside it they show what is far off.
Scene with_subject() {
    Scene scene = scene_named("far surfaces");
    add_square(scene, lambert(grey(0)), {-1.4, -1.4, 0}, {0, 0, 1}, 0.8);
    return scene;
}

constexpr std::size_t size = 32;  // of the pictures [pixels]

// Pixels of the upper right quarter.
std::vector<double> beside_subject(const RenderResult& result, const std::string& channel = "R") {
    const std::vector<float>& all = result.film.image.channels.at(channel);
    std::vector<double> values;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i / size < size / 2 && i % size >= size / 2) values.push_back(all[i]);
    return values;
}

// A slope of albedo .5 under a sky: every sample is .5, and .25 or less if its ray meets the slope
// again.
TEST(FarSurfaces, DoNotMeetThemselves) {
    for (const double distance : {1e4, 1e6}) {
        Scene scene = with_subject();
        scene.environment = constant_environment(1);
        add_square(scene, lambert(grey(0.5F)), {0, 0, -distance}, {0.3, 0.2, 1}, 20 * distance);
        RenderSettings settings =
            square_settings("bsdf", perspective({0, 0, 5}, {0, 0, 0}, 0.7), size, 64);
        settings.termination = {TerminationKind::zero, 0, 1};
        const std::vector<double> seen = beside_subject(render_scene(scene, settings));
        EXPECT_EQ(std::ranges::count_if(seen, [](double x) { return std::abs(x - 0.5) > 1e-6; }), 0)
            << distance;
    }
}

// A lamp of 1 m^2 lights a wall far behind what is seen: L A / d^2, times albedo / pi.
TEST(FarSurfaces, AreLitFromCloseBy) {
    for (const double distance : {1e4, 1e5}) {
        Scene scene = with_subject();
        const auto radiance = static_cast<float>(distance * distance);
        add_square(scene, lambert(grey(0), grey(radiance)), {4, 0, 0}, {0, 0, -1}, 1);
        add_square(scene, lambert(grey(0.5F)), {0, 0, -distance}, {0, 0, 1}, distance);
        for (const char* method : {"direct", "mis"}) {
            RenderSettings settings =
                square_settings(method, orthographic({0, 0, 5}, {0, 0, 0}, 4), size, 64);
            settings.termination = {TerminationKind::depth, 1, 1};
            const Estimate lit = estimate_of(beside_subject(render_scene(scene, settings)));
            EXPECT_TRUE(has_mean(lit, 0.5 / std::numbers::pi, {.tests = 4, .truth_error = 1e-5}))
                << method << " from " << distance;
        }
    }
}

// A roof a kilometre above keeps sun and sky off.
TEST(FarSurfaces, ShadeWhatIsClose) {
    Scene scene = with_subject();
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.direction = {0, 0, -1};
    sun.intensity = grey(3);
    scene.lights.push_back(sun);
    add_square(scene, lambert(grey(0.5F)), {0, 0, -0.5}, {0, 0, 1}, 20);
    add_square(scene, lambert(grey(0)), {0, 0, 1e3}, {0, 0, 1}, 1e6);
    for (const bool media : {false, true}) {
        if (media)
            add_box(scene, boundary_of(medium_of(0.1, 0)), {3, 3, 0}, {4, 4, 1}, Facing::outward);
        const RenderResult result = render_scene(
            scene, square_settings("direct", perspective({0, 0, 5}, {0, 0, 0}, 0.7), size, 4));
        const std::vector<double> seen = beside_subject(result);
        EXPECT_TRUE(std::ranges::all_of(seen, [](double x) { return x == 0; }));
        EXPECT_GT(beside_subject(result, "albedo.R")[0], 0);
    }
}

// In the far scene the block still stands on the table.
TEST(FarSurfaces, TouchAsCloseOnesDo) {
    const auto block = [](bool far) {
        Scene scene = scene_named("block");
        scene.environment = constant_environment(1);
        add_square(scene, lambert({0.8F, 0.5F, 0.3F}), {0, 0, 0}, {0, 0, 1}, 3);
        add_box(scene, glass(1.5), {-0.5, -0.5, 0}, {0.5, 0.5, 0.7}, Facing::outward);
        if (far) add_square(scene, lambert(grey(0)), {1e6, 2e5, -3e5}, {0, 0, 1}, 1);
        return render_scene(
            scene, square_settings("mis", perspective({1, -2, 2.4}, {0, 0, 0.2}, 0.7), size, 64));
    };
    const std::vector<double> near = beside_subject(block(false));
    const std::vector<double> far = beside_subject(block(true));
    std::vector<double> ratios;
    for (std::size_t i = 0; i < near.size(); ++i) ratios.push_back(1 + far[i] - near[i]);
    EXPECT_TRUE(has_mean(estimate_of(ratios), 1));
}

}  // namespace
}  // namespace wavepath
