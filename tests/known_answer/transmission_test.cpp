// Thin walls that let light through (KHR_materials_transmission).
#include "gltf/gltf_loader.h"
#include "support/case_files.h"
#include "support/rendering.h"

#include <cmath>

namespace wavepath {
namespace {

Scene wall(const Rgb& base, float roughness, float transmission) {
    Scene scene = scene_named("wall");
    Material material = dielectric(base, roughness);
    material.transmission = transmission;
    add_quad(scene, material, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    return scene;
}

double fresnel(double cosine) {
    return 0.04 + 0.96 * std::pow(1 - cosine, 5);
}

// Smooth: F of the sky is mirrored, and base (1 - F) seen straight through.
TEST(Transmission, OfASmoothWallIsWhatFresnelLeaves) {
    for (const Vec3d& eye : {Vec3d{0, 0, 2}, Vec3d{1.5, 0, 1.5}}) {
        const double f = fresnel(eye[0] == 0 ? 1 : std::sqrt(0.5));
        Scene scene = wall({1, 0.5F, 0.25F}, 0, 1);
        scene.environment = constant_environment(1);
        const RenderResult result = render_for(
            {}, scene, square_settings("mis", orthographic(eye, {0, 0, 0}, 0.1), 32, 64), "B");
        EXPECT_TRUE(has_mean(image_mean(result, "R"), 1));
        EXPECT_TRUE(has_mean(image_mean(result, "G"), f + (1 - f) / 2));
        EXPECT_TRUE(has_mean(image_mean(result, "B"), f + (1 - f) / 4));
    }
}

// Straight through: a dark sky, and a lamp that only the way through can reach.
TEST(Transmission, GoesStraightAhead) {
    Scene scene = wall(grey(0.5F), 0, 1);
    add_square(scene, lambert(grey(0), grey(1)), {-1, 0, -1}, {1, 0, 1}, 0.5);
    for (const char* method : {"path", "bsdf", "direct", "mis"}) {
        SCOPED_TRACE(method);
        const RenderResult result = render_for(
            {}, scene, square_settings(method, orthographic({1, 0, 1}, {0, 0, 0}, 0.1), 32, 64));
        EXPECT_TRUE(has_mean(
            image_mean(result), 0.5 * (1 - fresnel(std::sqrt(0.5))), {.truth_error = 1e-6}));
    }
}

// Rough walls: all methods agree on a lamp behind one, half of what enters comes back diffusely.
TEST(Transmission, OfRoughWallsIsTheSameInEveryMethod) {
    Scene scene = wall(grey(0.8F), 0.6F, 0.5F);
    add_square(scene, lambert(grey(0), grey(2)), {0.3, 0, -1}, {0, 0, 1}, 0.8);
    add_square(scene, lambert(grey(0), grey(1)), {-0.5, 0, 1.5}, {0, 0, -1}, 0.8);
    const Camera camera = orthographic({0.4, 0.2, 1}, {0, 0, 0}, 0.05);
    const RenderResult reference = render_for({}, scene, square_settings("mis", camera, 32, 64));
    for (const char* method : {"path", "bsdf", "direct", "direct-bsdf"}) {
        SCOPED_TRACE(method);
        const RenderResult result =
            render_for({.bias = 0.01}, scene, square_settings(method, camera, 32, 64));
        EXPECT_TRUE(agree(image_mean(result), image_mean(reference), {.bias = 0.015}));
    }
}

// None of it: what a material without shows. Not the same bits: the kernels are others, and
// contract other products.
TEST(Transmission, OfZeroChangesNothing) {
    Scene scene = wall(grey(0.8F), 0.4F, 0);
    add_square(scene, lambert(grey(0), grey(1)), {0, 0, 1}, {0, 0, -1}, 0.8);
    const RenderSettings settings =
        square_settings("mis", perspective({0.5, 0, 0.8}, {0, 0, 0}, 0.6), 16, 16);
    const RenderResult without = render_scene(scene, settings);
    // a material of the scene that does, out of sight
    Material glass = dielectric(grey(1), 0.3F);
    glass.transmission = 1;
    add_square(scene, glass, {0, 0, -0.9}, {0, 0, 1}, 0.1);
    const RenderResult with = render_scene(scene, settings);
    const std::vector<float>& a = without.film.image.channels.at("R");
    const std::vector<float>& b = with.film.image.channels.at("R");
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-5 * a[i] + 1e-7);
}

// The sun's light passes a smooth pane and loses what Fresnel takes at 0 degrees. Taken for opaque
// the pane leaves the floor black; without it the floor is .48 and .01 of gloss, by glTF's letter.
TEST(Transmission, LetsTheSunThroughAPaneFromAFile) {
    const auto folder = case_folder("thin-pane");
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    const Scene behind_pane = load_gltf(folder / "win_sun_0.gltf");
    Scene open = behind_pane;
    open.instances.pop_back();
    const auto floor = [](const Scene& scene, const char* termination) {
        RenderSettings settings =
            square_settings("mis", close_up({0, 0, 0}, {0, 0, 1}, 0.5, 1e-3), 16, 256);
        settings.termination = parse_termination(termination);
        settings.layers_conserve = false;
        return shared_mean(render_for({}, scene, settings));
    };
    // lit once, by the sun alone: no chance is involved
    EXPECT_NEAR(floor(open, "depth:1").mean / 0.49, 1, 1e-5);
    const double direct = 0.49 * (1 - fresnel(1));
    EXPECT_NEAR(floor(behind_pane, "depth:1").mean / direct, 1, 1e-5);
    // and what the pane mirrors of the floor, 5 m off, which is a thousandth of that
    EXPECT_TRUE(has_mean(floor(behind_pane, "roulette"), direct, {.truth_error = 2e-3}));
}

}  // namespace
}  // namespace wavepath
