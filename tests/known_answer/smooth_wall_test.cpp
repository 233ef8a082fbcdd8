// Light that goes straight through smooth thin walls: by connections and by chance, and not twice.
#include "support/images.h"
#include "support/media.h"
#include "support/rendering.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double albedo = 0.5;

Material pane(const Rgb& tint = grey(1), float transmission = 1) {
    Material material = dielectric(tint, 0);
    material.transmission = transmission;
    return material;
}

// What one pane lets through.
double straight(double cosine) {
    return 0.96 * (1 - std::pow(1 - cosine, 5));
}

double cosine_between(const Vec3d& a, const Vec3d& b) {
    return std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) /
           (std::hypot(a[0], a[1], a[2]) * std::hypot(b[0], b[1], b[2]));
}

// A floor at z = 0 under `count` panes of this normal, the lowest at z = .3.
Scene floor_under(int count, const Material& material, const Vec3d& normal = {0, 0, 1}) {
    Scene scene = scene_named("floor");
    add_square(scene, lambert(grey(albedo)), {0, 0, 0}, {0, 0, 1}, 2);
    for (int i = 0; i < count; ++i) add_square(scene, material, {0, 0, 0.3 + 0.05 * i}, normal, 2);
    return scene;
}

// Of the floor at the origin, seen from below the panes: light of one scattering.
RenderSettings at_the_floor(const char* method, uint64_t samples) {
    RenderSettings settings =
        square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.01, 1e-5), 16, samples);
    settings.termination = parse_termination("depth:1");
    return settings;
}

std::vector<PunctualLight> lights() {
    PunctualLight point;
    point.position = {0.3, 0.4, 1.2};  // 1.3 away
    point.intensity = grey(2);
    PunctualLight spot = point;
    spot.kind = LightKind::spot;
    spot.direction = {-3. / 13, -4. / 13, -12. / 13};
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = grey(3);
    sun.direction = spot.direction;
    return {point, spot, sun};
}

// Of the floor at the origin.
double irradiance_of(const PunctualLight& light) {
    const double cosine = 12. / 13;
    return light.kind == LightKind::directional ? 3 * cosine : 2 * cosine / (1.3 * 1.3);
}

TEST(SmoothWall, ConnectionsToPunctualLightsPassAnyNumber) {
    const Vec3d tilted{0.5, -0.2, 1};
    for (const Vec3d& normal : {Vec3d{0, 0, 1}, tilted})
        for (const int count : {1, 2, 5}) {
            Scene scene = floor_under(count, pane({0.8F, 0.5F, 1}), normal);
            const double passed = std::pow(straight(cosine_between(normal, {3, 4, 12})), count);
            for (const PunctualLight& light : lights()) {
                scene.lights = {light};
                for (const char* method : {"direct", "direct-bsdf", "mis"}) {
                    const RenderResult result = render_scene(scene, at_the_floor(method, 2));
                    const double clear = albedo / pi * irradiance_of(light) * passed;
                    const Strictness strictness{.truth_error = 2e-5};
                    EXPECT_TRUE(has_mean(
                        shared_mean(result, "R"), clear * std::pow(0.8, count), strictness));
                    EXPECT_TRUE(has_mean(
                        shared_mean(result, "G"), clear * std::pow(0.5, count), strictness));
                    EXPECT_TRUE(has_mean(shared_mean(result, "B"), clear, strictness));
                }
            }
        }
}

// A pane of metal, one whose texture says so, and a dark one let nothing through; a mask's holes
// and what a blend leaves open do.
TEST(SmoothWall, ConnectionsAskTheTextures) {
    const double clear = albedo / pi * irradiance_of(lights().back());
    const double passed = straight(12. / 13);
    const auto seen = [&](const Material& material, TextureUse use, const TextureImage& image) {
        Scene scene = floor_under(1, material);
        scene.primitives.back().uvs[0].assign(8, 0.5F);
        add_texture(scene, scene.materials.back(), use, image);
        scene.lights = {lights().back()};
        return shared_mean(render_scene(scene, at_the_floor("mis", 2))).mean / clear;
    };
    Material rough_unless_told = pane();
    rough_unless_told.roughness = 1;
    Material metal_where_told = pane();
    metal_where_told.metallic = 1;
    EXPECT_NEAR(seen(pane(), TEXTURE_BASE_COLOR, texel_image(.25, 1, 1)), passed / 4, 2e-5);
    EXPECT_NEAR(seen(pane(), TEXTURE_TRANSMISSION, texel_image(.25, 1, 1)), passed / 4, 2e-5);
    EXPECT_NEAR(
        seen(rough_unless_told, TEXTURE_METALLIC_ROUGHNESS, texel_image(0, 0, 0)), passed, 2e-5);
    EXPECT_EQ(seen(rough_unless_told, TEXTURE_METALLIC_ROUGHNESS, texel_image(0, 1, 0)), 0);
    EXPECT_EQ(seen(metal_where_told, TEXTURE_METALLIC_ROUGHNESS, texel_image(0, 0, 1)), 0);
    EXPECT_NEAR(
        seen(metal_where_told, TEXTURE_METALLIC_ROUGHNESS, texel_image(0, 0, .75)), passed / 4,
        3e-5);
}

TEST(SmoothWall, ConnectionsPassWhatABlendLeavesOpen) {
    Material material = pane();
    material.alpha_mode = AlphaMode::blend;
    material.alpha = 0.25F;
    Scene scene = floor_under(1, material);
    scene.lights = {lights().back()};
    const double passed = 0.75 + 0.25 * straight(12. / 13);
    EXPECT_TRUE(has_mean(
        shared_mean(render_for({}, scene, at_the_floor("mis", 256))),
        albedo / pi * irradiance_of(lights().back()) * passed));
}

// The same by smooth vertex normals, whose cosine is not the face's.
TEST(SmoothWall, FresnelGoesByTheShadingNormal) {
    Scene scene = floor_under(1, pane());
    for (int corner = 0; corner < 4; ++corner)
        for (const float x : {0.6F, 0.F, 0.8F}) scene.primitives.back().normals.push_back(x);
    scene.lights = {lights().back()};
    const double passed = straight(cosine_between({.6, 0, .8}, {3, 4, 12}));
    EXPECT_TRUE(has_mean(
        shared_mean(render_scene(scene, at_the_floor("mis", 2))),
        albedo / pi * irradiance_of(lights().back()) * passed, {.truth_error = 2e-5}));
}

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
