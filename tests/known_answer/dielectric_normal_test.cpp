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

// Light points against directions of the lobes alone, under a white sky.
TEST(RoughDielectric, OfSmoothNormalsIsLitAlike) {
    Scene scene = scene_named("sky");
    scene.environment = constant_environment(1);
    Material material = glass(1.5);
    material.roughness = 0.8F;
    material.base_color = {1, 0.5F, 1};
    add_coarse_ball(scene, material, 0);
    const auto render_with = [&](const char* method) {
        return render_for(
            {.bias = .007, .tests = 2}, scene,
            square_settings(method, perspective({0.5, 0.8, 3}, {0, 0, 0}, 0.6), 16, 256), "G");
    };
    const RenderResult bsdf = render_with("bsdf");
    const RenderResult direct = render_with("direct-bsdf");
    for (const char* channel : {"R", "G"})
        EXPECT_TRUE(agree(
            image_mean(bsdf, channel), image_mean(direct, channel), {.bias = .01, .tests = 2}))
            << channel;
}

}  // namespace
}  // namespace wavepath
