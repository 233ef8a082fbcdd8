// Glass that transmits in part: Fresnel's interface beside an opaque rest.
#include "support/partial_boundaries.h"
#include "support/rendering.h"

#include <array>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};
constexpr std::array<double, 2> base{1, 0.5};
constexpr double half = 400;  // [m] of plates, whose sides are nowhere to be seen

Material tinted(Material material) {
    material.base_color = {static_cast<float>(base[0]), static_cast<float>(base[1]), 0};
    return material;
}

// A plate of glass below z = 0 that nothing comes back from.
Scene black_glass(double t, double m, bool by_textures) {
    Scene scene = scene_named("black glass");
    Material material = tinted(glass(1.5, black()));
    if (!by_textures) material = in_part(material, t, m);
    add_box(scene, material, {-half, -half, -1}, {half, half, 0}, Facing::outward);
    if (!by_textures) return scene;
    lay_out_flat(scene.primitives.back());
    scene.materials[0].metallic = 1;
    add_texture(scene, scene.materials[0], TEXTURE_TRANSMISSION, texel_image(t, 0, 0));
    add_texture(scene, scene.materials[0], TEXTURE_METALLIC_ROUGHNESS, texel_image(0, 1, m));
    return scene;
}

struct Share {
    double t, m;
};
constexpr Share shares[] = {{0.4, 0}, {1, 0.6}, {0.5, 0.4}};

// Along the normal, under a white sky: t (1 - m) .04 of the interface, and of the rest, smooth
// metal or Lambert's, the base colour.
TEST(PartialGlass, ReflectsWhatItDoesNotTransmit) {
    const Strictness strictness{.tests = 12, .truth_error = 1e-5};
    for (const bool by_textures : {false, true})
        for (const auto& [t, m] : shares) {
            SCOPED_TRACE(fmt::format("t {}, m {}, textures {}", t, m, by_textures));
            Scene scene = black_glass(t, m, by_textures);
            scene.environment = constant_environment(1);
            const RenderResult result =
                render_for(strictness, scene, square_settings("mis", along(1), 16, 64), "G");
            const double share = t * (1 - m);
            for (std::size_t c = 0; c < base.size(); ++c)
                EXPECT_TRUE(has_mean(
                    shared_mean(result, channels[c]), share * 0.04 + (1 - share) * base[c],
                    strictness))
                    << channels[c];
        }
}

// A sun is not mirrored by what is smooth. Left is the diffuse part, (1 - t) (1 - m).
TEST(PartialGlass, IsDiffuseAsGltfMixesIt) {
    const Strictness strictness{.tests = 8, .truth_error = 1e-5};
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = grey(std::numbers::pi_v<float>);
    for (const bool by_textures : {false, true})
        for (const char* method : {"mis", "direct"})
            for (const auto& [t, m] : {shares[0], shares[2]}) {
                SCOPED_TRACE(fmt::format("t {}, m {}, {}, {}", t, m, by_textures, method));
                Scene scene = black_glass(t, m, by_textures);
                scene.lights = {sun};
                const RenderResult result =
                    render_for(strictness, scene, square_settings(method, along(1), 16, 64));
                EXPECT_TRUE(has_mean(shared_mean(result), (1 - t) * (1 - m) * base[0], strictness));
            }
}

// Nor is it one where the scene has one: nothing goes through it.
TEST(PartialGlass, RestIsNoThinWall) {
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = grey(std::numbers::pi_v<float>);
    Scene scene = black_glass(0.5, 0.4, true);
    scene.lights = {sun};
    Material wall = lambert(grey(1));
    wall.transmission = 1;
    add_square(scene, wall, {5, 5, 1}, {0, 0, 1}, 1);
    const Strictness strictness{.truth_error = 1e-5};
    EXPECT_TRUE(has_mean(
        shared_mean(render_for(strictness, scene, square_settings("mis", along(1), 16, 64))),
        0.5 * 0.6 * base[0], strictness));
}

// It emits whatever becomes of the path.
TEST(PartialGlass, EmitsAllTheSame) {
    Scene scene = black_glass(0.5, 0.4, false);
    scene.materials[0].emission = {1, 2, 3};
    for (const char* method : {"direct", "mis"}) {
        const RenderResult result = render_scene(scene, square_settings(method, along(1), 8, 16));
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_EQ(shared_mean(result, channels[c]).mean, 1.0 + static_cast<double>(c));
    }
}

// Of n = 4, F = .36, over a face that is half a mirror: a ray that comes to the same point in the
// same direction decides anew. F + (1 - F)^2 R / (1 - F R), R = (1 + F) / 2 of the lower face.
TEST(PartialGlass, DecidesAnewAtEveryHit) {
    Scene scene = scene_named("mirror below");
    add_box_with_top(
        scene, in_part(glass(4), 1, 0.5), glass(4), {-half, -half, -1}, {half, half, 0});
    add_square(scene, lambert(grey(0)), {0, 0, -2}, {0, 0, 1}, 3 * half);
    scene.environment = constant_environment(1);
    constexpr double f = 0.36;
    constexpr double lower = (1 + f) / 2;
    constexpr double truth = f + (1 - f) * (1 - f) * lower / (1 - f * lower);
    const Strictness strictness{.tests = 2, .truth_error = 1e-5};
    RenderSettings settings = square_settings("mis", along(1), 16, 64);
    EXPECT_TRUE(has_mean(shared_mean(render_for(strictness, scene, settings)), truth, strictness));
    settings.splits.reflections = 3;
    settings.split_depth = 4;
    EXPECT_TRUE(has_mean(shared_mean(render_for(strictness, scene, settings)), truth, strictness));
}

// White, clear or full of what only scatters, it is not seen under a white sky, whatever part
// transmits.
TEST(PartialGlass, KeepsTheFurnace) {
    const Strictness strictness{.tests = 8};
    for (const Medium& medium : {medium_of(0, 0), medium_of(1, 1)})
        for (const auto& [t, m] : {Share{0.5, 0}, Share{0.75, 0.5}}) {
            Scene scene = scene_named("white glass");
            scene.environment = constant_environment(1);
            add_box(
                scene, in_part(glass(1.5, medium), t, m), {-1, -1, -1}, {1, 1, 1}, Facing::outward);
            RenderSettings settings =
                square_settings("mis", perspective({2, 3, 4}, {0, 0, 0}, 0.6), 32, 32);
            EXPECT_TRUE(
                has_mean(image_mean(render_for(strictness, scene, settings)), 1, strictness))
                << t;
            settings.method.distances = Distances::mis;
            settings.splits = {2, 2, 2};
            settings.split_depth = 2;
            EXPECT_TRUE(
                has_mean(image_mean(render_for(strictness, scene, settings)), 1, strictness))
                << t;
        }
}

// Just above Lambert's floor of albedo rho, in contact: light in the glass meets the floor with
// probability t, else the white rest of the lower face: one floor of albedo t rho + 1 - t
// (Contact.PaneOnAFloor).
TEST(PartialGlass, RestOfAFaceHidesTheFloorThatTouchesIt) {
    constexpr double t = 0.5;
    constexpr double inside = .5963457597;
    constexpr double gap = 2e-4;
    const Strictness strictness{.tests = 4, .truth_error = 1e-6};
    for (const bool floor_first : {true, false}) {
        Scene scene = scene_named("floor");
        scene.environment = constant_environment(1);
        const auto add_ground = [&] {
            add_square(scene, lambert({0.5F, 0.8F, 0}), {0, 0, -1}, {0, 0, 1}, 2 * half);
        };
        if (floor_first) add_ground();
        add_box_with_top(
            scene, in_part(glass(1.5), t), glass(1.5), {-half, -half, -1 + gap}, {half, half, 0});
        if (!floor_first) add_ground();
        const RenderResult result =
            render_for(strictness, scene, square_settings("mis", along(1), 16, 64));
        for (const auto& [channel, rho] : {std::pair("R", 0.5), std::pair("G", 0.8)}) {
            const double floor = t * rho + 1 - t;
            EXPECT_TRUE(has_mean(
                shared_mean(result, channel),
                .04 + .96 * floor * (1 - inside) / (1 - floor * inside), strictness))
                << channel;
        }
    }
}

double fresnel(double cosine) {  // from within n = 1.5
    const double sine2 = 2.25 * (1 - cosine * cosine);
    if (sine2 >= 1) return 1;
    const double beyond = std::sqrt(1 - sine2);
    const double s = (1.5 * cosine - beyond) / (1.5 * cosine + beyond);
    const double p = (cosine - 1.5 * beyond) / (cosine + 1.5 * beyond);
    return (s * s + p * p) / 2;
}

// Glass on a black body of which the share t lets light in: at the glass's lower face light is
// reflected by Fresnel's equations and lost with probability t, else scattered by a white Lambert
// surface that stands in the place of the face. Upwards it carries U = 1 - F + F D, downwards D = t
// F U + (1 - t) L, L = 2 integral of mu U.
TEST(PartialGlass, MeetsTheRestOfWhatTouchesIt) {
    constexpr double t = 0.5;
    double free = 0;  // L = free + factor L
    double factor = 0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        const double mu = (i + 0.5) / steps;
        const double f = fresnel(mu);
        const double weight = 2 * mu / steps / (1 - t * f * f);
        free += weight * (1 - f);
        factor += weight * f * (1 - t);
    }
    const double scattered = free / (1 - factor);
    const double f = fresnel(1);
    const double up = (1 - f + f * (1 - t) * scattered) / (1 - t * f * f);
    const double truth = f + (1 - f) * (t * f * up + (1 - t) * scattered);

    const Strictness strictness{.tests = 4, .truth_error = 1e-5};
    for (const double gap : {0.0, -2e-4})
        for (const bool body_first : {true, false}) {
            Scene scene = scene_named("touching");
            scene.environment = constant_environment(1);
            const auto add_body = [&] {
                add_box(
                    scene, in_part(boundary_of(black()), t), {-half, -half, -2},
                    {half, half, -1 + gap}, Facing::outward);
            };
            if (body_first) add_body();
            add_box(scene, glass(1.5), {-half, -half, -1}, {half, half, 0}, Facing::outward);
            if (!body_first) add_body();
            EXPECT_TRUE(has_mean(
                shared_mean(
                    render_for(strictness, scene, square_settings("mis", along(1), 16, 64))),
                truth, strictness))
                << "gap " << gap << ", body first " << body_first;
        }
}

}  // namespace
}  // namespace wavepath
