// Connections through smooth thin walls to lights at points and to suns.
#include "support/images.h"
#include "support/smooth_walls.h"

#include <numbers>

namespace wavepath {
namespace {

using std::numbers::pi;

double cosine_between(const Vec3d& a, const Vec3d& b) {
    return std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) /
           (std::hypot(a[0], a[1], a[2]) * std::hypot(b[0], b[1], b[2]));
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

}  // namespace
}  // namespace wavepath
