// Textures of what encloses a medium: roughness, and metalness that leaves nothing opaque.
#include "support/partial_boundaries.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

// Not the same bits: the kernels are others.
void expect_near(const RenderResult& a, const RenderResult& b) {
    for (const char* channel : {"R", "G", "B"}) {
        const std::vector<float>& x = a.film.image.channels.at(channel);
        const std::vector<float>& y = b.film.image.channels.at(channel);
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_NEAR(x[i], y[i], 2e-4 * x[i] + 1e-6) << channel << ", pixel " << i;
    }
}

// A ball that absorbs, and a box around fog, on a floor.
Scene bodies(const Material& ball, const Material& fog) {
    Scene scene = scene_named("bodies");
    add_icosphere(scene, ball, {-0.5, 0, 0}, 0.45, 2);
    lay_out_flat(scene.primitives.back());
    add_box(scene, fog, {0.1, -0.4, -0.4}, {0.9, 0.4, 0.4}, Facing::outward);
    lay_out_flat(scene.primitives.back());
    add_square(scene, lambert(grey(0.7F)), {0, 0, -0.6}, {0, 0, 1}, 4);
    add_square(scene, lambert(grey(0), grey(4)), {0, 0.5, 2}, {0, 0, -1}, 1);
    scene.environment = constant_environment(0.2F);
    return scene;
}

RenderSettings settings() {
    return square_settings("mis", perspective({0, -2, 2.5}, {0, 0, 0}, 0.6), 24, 16);
}

TEST(VolumeTextures, RoughnessIsItsFactor) {
    Medium absorbing;
    absorbing.sigma_a = {1, 2, 4};
    Material ball = glass(1.5, absorbing);
    for (const double roughness : {0.5, 0.0}) {
        ball.roughness = static_cast<float>(roughness);
        const RenderResult factors =
            render_scene(bodies(ball, boundary_of(medium_of(2, 0.8))), settings());
        ball.roughness = 1;
        Scene textured = bodies(ball, boundary_of(medium_of(2, 0.8)));
        add_texture(
            textured, textured.materials[0], TEXTURE_METALLIC_ROUGHNESS,
            texel_image(0, roughness, 1));
        expect_near(factors, render_scene(textured, settings()));
    }
}

// Smooth where the texture's green is 0, left, and rough on the right: each half is that of a plate
// of one roughness.
TEST(VolumeTextures, RoughnessIsThatOfTheHit) {
    Medium absorbing;
    absorbing.sigma_a = grey(1e4F);
    const auto plate = [&](float roughness) {
        Material material = glass(1.5, absorbing);
        material.roughness = roughness;
        Scene scene = scene_named("plate");
        add_box(scene, material, {0, 0, -1}, {1, 1, 0}, Facing::outward);
        lay_out_flat(scene.primitives.back());
        add_square(scene, lambert(grey(0), grey(4)), {0.2, 0.4, 2}, {0, 0, -1}, 1);
        scene.environment = constant_environment(0.2F);
        return scene;
    };
    Scene halves = plate(0.5F);
    add_texture(
        halves, halves.materials[0], TEXTURE_METALLIC_ROUGHNESS,
        image_of(2, 1, {0, 0, 0, 255, 0, 255, 0, 255}))
        .nearest = true;
    const RenderSettings view =
        square_settings("mis", orthographic({0.5, 0.5, 1}, {0.5, 0.5, 0}, 1), 16, 16);
    const RenderResult both = render_scene(halves, view);
    const RenderResult smooth = render_scene(plate(0), view);
    const RenderResult rough = render_scene(plate(0.5F), view);
    for (std::size_t i = 0; i < 256; ++i) {
        const RenderResult& alone = i % 16 < 8 ? smooth : rough;
        const float truth = alone.film.image.channels.at("R")[i];
        EXPECT_NEAR(both.film.image.channels.at("R")[i], truth, 2e-5 * truth + 1e-6) << i;
    }
}

// What exporters write for glass: metallicFactor 1 and a texture whose blue is 0.
TEST(VolumeTextures, OfNoMetalLeaveAllToTheBoundary) {
    Medium absorbing;
    absorbing.sigma_a = {1, 2, 4};
    Material ball = glass(1.5, absorbing);
    ball.roughness = 0.3F;
    Material fog = boundary_of(medium_of(2, 0.8));
    const RenderResult plain = render_scene(bodies(ball, fog), settings());
    ball.metallic = 1;
    fog.metallic = 1;
    Scene textured = bodies(ball, fog);
    for (std::size_t m = 0; m < 2; ++m) {
        add_texture(
            textured, textured.materials[m], TEXTURE_METALLIC_ROUGHNESS, texel_image(1, 1, 0));
        add_texture(textured, textured.materials[m], TEXTURE_TRANSMISSION, texel_image(1, 0, 0));
    }
    expect_near(plain, render_scene(textured, settings()));
}

}  // namespace
}  // namespace wavepath
