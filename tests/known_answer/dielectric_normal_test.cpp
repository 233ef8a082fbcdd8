// Glass with vertex normals: a coarse ball, whose lobes reach to the wrong side of many a face.
#include "support/media.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

void add_coarse_ball(Scene& scene, const Material& material, int subdivisions) {
    Primitive& ball = add_icosphere(scene, material, {0, 0, 0}, 1, subdivisions);
    ball.normals = ball.positions;
}

TEST(Dielectric, OfSmoothNormalsLosesNothing) {
    Scene scene = scene_named("furnace");
    scene.environment = constant_environment(1);
    add_coarse_ball(scene, glass(1.5), 2);  // coarser ones trap rays for long
    const RenderResult result =
        render_scene(scene, square_settings("mis", perspective({0, 0, 4}, {0, 0, 0}, 0.5), 16, 16));
    EXPECT_NEAR(image_mean(result).mean, 1, 1e-5);
}

// Light points against directions of the lobes alone.
TEST(RoughDielectric, OfSmoothNormalsIsLitAlike) {
    Scene scene = scene_named("lamp");
    Material material = glass(1.5);
    material.roughness = 0.7F;
    material.base_color = {1, 0.5F, 1};
    add_coarse_ball(scene, material, 1);
    add_square(scene, lambert(grey(0), grey(3), true), {0, 0.5, -2}, {0, 0, 1}, 3);
    const auto render_with = [&](const char* method) {
        return render_for(
            {.bias = .006, .tests = 4}, scene,
            square_settings(method, perspective({0.5, 0.8, 3}, {0, 0, 0}, 0.7), 16, 256), "R");
    };
    const RenderResult bsdf = render_with("bsdf");
    const RenderResult mis = render_with("mis");  // direct would take a hundred times the samples
    for (const char* channel : {"R", "G"})
        EXPECT_TRUE(
            agree(image_mean(bsdf, channel), image_mean(mis, channel), {.bias = .01, .tests = 4}))
            << channel;
}

}  // namespace
}  // namespace wavepath
