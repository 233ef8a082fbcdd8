// Light that goes straight through smooth thin walls: by connections and by chance, and not twice.
#include "support/media.h"
#include "support/smooth_walls.h"

#include <numbers>

namespace wavepath {
namespace {

using std::numbers::pi;

// E / pi of a floor under `count` level panes and a lamp of radiance 1 and side 3 at z = .6.
double lamp_through(int count) {
    constexpr int steps = 400;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double x = -1.5 + (i + .5) * 3 / steps;
            const double y = -1.5 + (k + .5) * 3 / steps;
            const double d2 = x * x + y * y + .36;
            const double cosine = .6 / std::sqrt(d2);
            sum += cosine * cosine / d2 * std::pow(straight(cosine), count);
        }
    return sum * (3. / steps) * (3. / steps) / pi;
}

// What connections and chance find together is the light that there is.
TEST(SmoothWall, AreaLightsAreCountedOnce) {
    Scene scene = floor_under(2, pane());
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 0.6}, {0, 0, -1}, 3);
    for (const char* method : {"path", "bsdf", "direct", "direct-bsdf", "mis"}) {
        SCOPED_TRACE(method);
        const Strictness strictness{.truth_error = 2e-5};
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, scene, at_the_floor(method, 256))),
            albedo * lamp_through(2), strictness));
    }
}

// 2 times the integral over c of straight(c)^count c.
double sky_through(int count) {
    constexpr int steps = 100000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double c = (i + .5) / steps;
        sum += 2 * c * std::pow(straight(c), count) / steps;
    }
    return sum;
}

TEST(SmoothWall, SkiesAreCountedOnce) {
    const Environment map{grey(1), 16, 8, std::vector<float>(std::size_t{3} * 16 * 8, 1), ""};
    Scene scene = scene_named("floor");
    add_square(scene, lambert(grey(albedo)), {0, 0, 0}, {0, 0, 1}, 100);
    for (const double z : {.2, .25}) add_square(scene, pane(), {0, 0, z}, {0, 0, 1}, 100);
    for (const Environment& sky : {constant_environment(1), map}) {
        scene.environment = sky;
        for (const char* method : {"path", "direct", "mis"}) {
            SCOPED_TRACE(method);
            const Strictness strictness{
                .bias = std::string(method) == "direct" ? .01 : .005, .truth_error = 3e-5};
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(strictness, scene, at_the_floor(method, 256))),
                albedo * sky_through(2), strictness));
        }
    }
}

// White panes and half of one that scatters the rest neither take nor give.
TEST(SmoothWall, KeepTheFurnaceWhite) {
    Scene scene = scene_named("furnace");
    scene.environment = constant_environment(1);
    add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 2);
    Material half = lambert(grey(1));
    half.roughness = 0;
    half.transmission = 0.5F;
    add_square(scene, pane(), {0, 0, 0.2}, {0.2, 0, 1}, 1.5);
    add_square(scene, half, {0, 0, 0.5}, {0, 0, 1}, 1.5);
    const Camera camera = perspective({0.3, 0.2, 1}, {0, 0, 0}, 0.4);
    for (const char* method : {"path", "bsdf", "direct", "direct-bsdf", "mis"}) {
        SCOPED_TRACE(method);
        EXPECT_TRUE(has_mean(
            image_mean(render_for({.bias = .01}, scene, square_settings(method, camera, 16, 64))),
            1, {.bias = .01}));
    }
}

// No scattering: depth:0 sees a lamp through two panes, depth:1 a floor in the sun, and branches
// are left to what scatters.
TEST(SmoothWall, IsNoScattering) {
    Scene scene = floor_under(2, pane());
    scene.lights = {lights().back()};
    const double sunlit =
        albedo / pi * irradiance_of(scene.lights[0]) * std::pow(straight(12. / 13), 2);
    RenderSettings settings =
        square_settings("mis", orthographic({0, 0, 0.5}, {0, 0, 0}, 0.01), 16, 256);
    settings.termination = parse_termination("depth:1");
    EXPECT_TRUE(
        has_mean(shared_mean(render_for({}, scene, settings)), sunlit * std::pow(straight(1), 2)));
    settings.splits.reflections = 4;
    settings.split_depth = 2;
    EXPECT_TRUE(
        has_mean(shared_mean(render_for({}, scene, settings)), sunlit * std::pow(straight(1), 2)));
    settings.splits = {};
    scene.lights.clear();
    scene.materials[0] = lambert(grey(0), grey(1));
    const double passed = std::pow(straight(1), 2);
    settings.splits = {};
    settings.termination = parse_termination("depth:0");
    EXPECT_TRUE(has_mean(shared_mean(render_for({}, scene, settings)), passed));
    // of what is mirrored between the panes half survives each time, and is worth twice as much
    settings.termination = parse_termination("roulette:.5");
    EXPECT_TRUE(
        has_mean(shared_mean(render_for({}, scene, settings)), passed / (1 - std::pow(.04, 2))));
}

// A pane in fog, and one in the plane in which the fog ends, before and behind it.
TEST(SmoothWall, StandsInFog) {
    constexpr double sigma = 0.8;
    struct Case {
        double top, inside;  // of the fog, and its depth above the floor [m]
    };
    for (const auto& [top, inside] :
         {Case{1, 1}, Case{.3, .3}, Case{.3 + 2e-6, .3}, Case{.3 - 2e-6, .3}}) {
        Scene scene = floor_under(1, pane());
        add_box(
            scene, boundary_of(medium_of(sigma, 0)), {-1.5, -1.5, -.5}, {1.5, 1.5, top},
            Facing::outward);
        PunctualLight sun;
        sun.kind = LightKind::directional;
        sun.intensity = grey(3);
        scene.lights = {sun};
        const double fog = std::exp(-sigma * (inside + .01));
        const double sunlit = albedo / pi * 3 * straight(1) * fog;
        EXPECT_TRUE(has_mean(
            shared_mean(render_scene(scene, at_the_floor("mis", 2))), sunlit,
            {.truth_error = 2e-5}))
            << top;
        // a lamp far above, of the sun's irradiance, that chance finds as well
        scene.lights.clear();
        add_square(scene, lambert(grey(0), grey(1)), {0, 0, 1.5}, {0, 0, -1}, 4);
        const Strictness strictness{.bias = .01};
        const auto mean = [&](const char* method) {
            return shared_mean(render_for({.bias = .0065}, scene, at_the_floor(method, 256)));
        };
        const Estimate by_chance = mean("path");
        EXPECT_TRUE(agree(by_chance, mean("direct"), strictness)) << top;
        EXPECT_TRUE(agree(by_chance, mean("mis"), strictness)) << top;
    }
}

// Panes that transmit in part, shine and mirror, lamps of either kind, a mapped sky: every method
// that finds the lights has one mean.
TEST(SmoothWall, IsTheSameInEveryMethod) {
    Scene scene = floor_under(0, pane());
    Material shining = pane({0.9F, 0.7F, 0.5F}, 0.6F);
    shining.emission = grey(0.2F);
    add_square(scene, shining, {0, 0, 0.4}, {0.3, 0, 1}, 1.5);
    add_square(scene, pane(grey(0.9F), 0.8F), {-0.4, 0, 0.4}, {1, 0, 0.2}, 1);
    add_square(scene, lambert(grey(0.3F), grey(1)), {0.2, 0, 1}, {0, 0, -1}, 1.5);
    scene.environment =
        Environment{grey(0.3F), 16, 8, std::vector<float>(std::size_t{3} * 16 * 8, 1), ""};
    const Camera camera = perspective({1.2, 0.3, 0.8}, {0, 0, 0.2}, 0.7);
    const auto render_with = [&](const char* method) {
        RenderSettings settings = square_settings(method, camera, 32, 64);
        settings.seed = static_cast<uint32_t>(std::string(method).size());
        return image_mean(render_for({.bias = .005, .tests = 4}, scene, settings));
    };
    const Estimate mis = render_with("mis");
    for (const char* method : {"path", "bsdf", "direct", "direct-bsdf"})
        EXPECT_TRUE(agree(render_with(method), mis, {.bias = .0075, .tests = 4})) << method;
}

}  // namespace
}  // namespace wavepath
