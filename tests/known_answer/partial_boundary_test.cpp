// Volumes that transmit in part: index-matched boundaries beside an opaque rest.
#include "support/partial_boundaries.h"
#include "support/rendering.h"
#include "support/textured_scenes.h"

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

// Two faces that pass t b and reflect r = (1 - t) b diffusely, over black: r + (t b)^2 r / (1 -
// r^2). `direct` connects the lower face to the sky through the upper one.
TEST(PartialBoundary, PlateReflectsAndTransmitsByEveryMethod) {
    constexpr double t = 0.375;
    Material face = in_part(boundary_of({}), t);
    face.base_color = {1, 0.75F, 0};
    Scene scene = scene_named("plate");
    add_box(scene, face, {-0.5, -0.5, -1}, {0.5, 0.5, 0}, Facing::outward);
    split_off(scene, 12, metal(grey(1), 0));
    add_floor(scene, lambert(grey(0)));
    scene.environment = constant_environment(1);
    const Strictness strictness{.tests = 6, .truth_error = 1e-5};
    const auto check = [&](const RenderSettings& settings) {
        const RenderResult result = render_for(strictness, scene, settings, "G");
        for (const auto& [channel, b] : {std::pair("R", 1.0), std::pair("G", 0.75)}) {
            const double r = (1 - t) * b;
            const double truth = r + t * t * b * b * r / (1 - r * r);
            EXPECT_TRUE(has_mean(shared_mean(result, channel), truth, strictness)) << channel;
        }
    };
    for (const char* method : {"path", "direct"}) {  // all there are: nothing here has a lobe
        SCOPED_TRACE(method);
        check(square_settings(method, along(1), 16, 64));
    }
    RenderSettings split = square_settings("direct", along(1), 16, 16);
    split.splits.reflections = 2;
    split.split_depth = 2;
    SCOPED_TRACE("splits");
    check(split);
}

// A lamp below fog of tau = .5 under a face whose transmission runs from .2 to 1.
TEST(PartialBoundary, ShowsAGradientOfTransmission) {
    const Material fog = boundary_of(medium_of(0.5, 0));
    Scene scene = scene_named("gradient");
    add_box_with_top(scene, fog, fog, {0, 0, -1}, {1, 1, 0});
    Texture& texture = add_texture(
        scene, scene.materials[1], TEXTURE_TRANSMISSION,
        image_of(2, 1, {51, 0, 0, 255, 255, 0, 0, 255}));
    texture.transform = {0.5F, 0, 0.25F, 0, 1, 0};  // from texel centre to texel centre
    add_square(scene, lambert(grey(0), grey(1)), {0.5, 0.5, -1.5}, {0, 0, 1}, 2);
    const Camera camera = orthographic({0.5, 0.5, 1}, {0.5, 0.5, 0}, 1);
    const std::vector<Estimate> blocks =
        block_image_means(render_scene(scene, square_settings("mis", camera, 32, 4096)));
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const double middle = (static_cast<double>(k % 8) + 0.5) / 8;
        EXPECT_TRUE(has_mean(
            blocks[k], (0.2 + 0.8 * middle) * std::exp(-0.5),
            {.bias = 0.07, .tests = blocks.size()}))
            << "block " << k;
    }
}

// Metal on the right, which mirrors a lamp of 2, a boundary on the left, before a lamp of 1: both
// by the blue of one texture. Nothing is left to chance.
TEST(PartialBoundary, IsMetalWhereATextureSaysSo) {
    Material face = in_part(boundary_of(medium_of(0.5, 0)), 1, 1);
    face.base_color = grey(0.5F);
    face.roughness = 0;
    Scene scene = scene_named("halves");
    add_box_with_top(scene, boundary_of(medium_of(0.5, 0)), face, {0, 0, -1}, {1, 1, 0});
    add_texture(
        scene, scene.materials[1], TEXTURE_METALLIC_ROUGHNESS,
        image_of(2, 1, {0, 0, 0, 255, 0, 0, 255, 255}))
        .nearest = true;
    add_square(scene, lambert(grey(0), grey(1)), {0.5, 0.5, -1.5}, {0, 0, 1}, 2);
    add_square(scene, lambert(grey(0), grey(2)), {0.5, 0.5, 2}, {0, 0, -1}, 2);
    const Camera camera = orthographic({0.5, 0.5, 1}, {0.5, 0.5, 0}, 1);
    for (const char* method : {"path", "direct", "mis"}) {
        const RenderResult result = render_scene(scene, square_settings(method, camera, 8, 4));
        const std::vector<float>& red = result.film.image.channels.at("R");
        for (std::size_t i = 0; i < red.size(); ++i)
            EXPECT_NEAR(red[i], i % 8 < 4 ? 0.5 * std::exp(-0.5) : 1, 1e-5) << method;
    }
}

// A sun through a face that transmits t (1 - m) by its textures, seen from below it.
TEST(PartialBoundary, ConnectsThroughTextures) {
    Scene scene = scene_named("sun");
    add_box_with_top(
        scene, boundary_of({}), in_part(boundary_of({}), 1, 1), {-9, -9, -1}, {9, 9, 0});
    add_texture(scene, scene.materials[1], TEXTURE_TRANSMISSION, texel_image(0.5, 1, 1));
    add_texture(scene, scene.materials[1], TEXTURE_METALLIC_ROUGHNESS, texel_image(1, 1, 0.25));
    add_square(scene, lambert(grey(1)), {0, 0, -1.1}, {0, 0, 1}, 18);
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = grey(std::numbers::pi_v<float>);
    scene.lights = {sun};
    const Camera camera = orthographic({0.1, 0.2, -0.5}, {0.1, 0.2, -1}, 0.1);
    for (const char* method : {"mis", "direct"}) {
        RenderSettings settings = depth_limited(camera, 4, 4, 1);
        settings.method = method_named(method);
        EXPECT_NEAR(shared_mean(render_scene(scene, settings)).mean, 0.375, 1e-5) << method;
    }
}

// To pass is no scattering, to be reflected is one: t of the lamp below, then (1 - t) of the sky
// and what the lower side of the face sends back into the sky.
TEST(PartialBoundary, CountsReflectionsAsScatterings) {
    constexpr double t = 0.5;
    Scene scene = scene_named("depth");
    add_box_with_top(
        scene, boundary_of({}), in_part(boundary_of({}), t), {-9, -9, -0.01}, {9, 9, 0});
    add_square(scene, lambert(grey(0), grey(2)), {0, 0, -0.02}, {0, 0, 1}, 18);
    scene.environment = constant_environment(1);
    const Strictness strictness{.tests = 4, .truth_error = 1e-5};
    for (const char* method : {"mis", "direct"})
        for (const uint32_t depth : {0U, 1U}) {
            const double truth = 2 * t + (depth > 0 ? 1 - t : 0);
            RenderSettings settings = depth_limited(along(1), 16, 64, depth);
            settings.method = method_named(method);
            EXPECT_TRUE(
                has_mean(shared_mean(render_for(strictness, scene, settings)), truth, strictness))
                << method << ", depth " << depth;
        }
}

// Light points on the sky and on a lamp through microfacets, fog, and both faces, against
// directions alone; and paths that branch.
TEST(PartialBoundary, FogIsTheSameByEveryMethod) {
    Scene scene = scene_named("fog");
    Material face = in_part(boundary_of(medium_of(2, {0.9F, 0.5F, 0})), 0.6, 0.3);
    face.roughness = 0.6F;
    face.specular = 1;
    face.base_color = {0.9F, 0.8F, 0.7F};
    add_box(scene, face, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, Facing::outward);
    add_square(scene, lambert(grey(0), grey(3)), {0, 0.4, 1.5}, {0, 0, -1}, 1);
    add_square(scene, lambert(grey(0.5F)), {0, -0.6, 0}, {0, 1, 0}, 3);
    scene.environment = constant_environment(0.3F);
    const Camera camera = perspective({0.8, 1, 2}, {0, 0, 0}, 0.4);
    RenderSettings settings = square_settings("bsdf", camera, 32, 256);
    const Strictness strictness{.bias = 0.02, .tests = 8};
    const RenderResult reference = render_for(strictness, scene, settings);
    const auto check = [&](RenderSettings other) {
        other.seed = 7;
        const RenderResult result = render_for(strictness, scene, other);
        for (const char* channel : {"R", "B"})
            EXPECT_TRUE(agree(
                image_mean(result, channel), image_mean(reference, channel),
                {.bias = 0.03, .tests = 8}))
                << channel;
    };
    for (const char* method : {"mis", "direct", "direct-bsdf"}) {
        SCOPED_TRACE(method);
        settings.method = method_named(method);
        check(settings);
    }
    SCOPED_TRACE("splits");
    settings = square_settings("mis", camera, 32, 16);
    settings.method.distances = Distances::mis;
    settings.splits = {2, 2, 2};
    settings.split_depth = 3;
    check(settings);
}

}  // namespace
}  // namespace wavepath
