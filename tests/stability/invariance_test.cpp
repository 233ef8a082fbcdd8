// Where a scene lies and how large it is must not show.
#include "support/rendering.h"

namespace wavepath {
namespace {

// A corner with a block, a square light and a point light, about 2 m wide.
Scene corner() {
    Scene scene = scene_named("corner");
    add_quad(scene, lambert(grey(0.6F)), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    add_quad(scene, lambert({0.7F, 0.3F, 0.2F}), {-1, -1, 0}, {0, 2, 0}, {0, 0, 1.5});
    add_box(scene, lambert(grey(0.5F)), {-0.3, -0.2, 0.001}, {0.2, 0.3, 0.6}, Facing::outward);
    add_square(scene, lambert(grey(0), grey(5)), {0.2, 0.1, 1.4}, {0, 0, -1}, 0.5);
    PunctualLight light;
    light.position = {0.8, -0.6, 0.9};
    light.intensity = grey(0.5F);
    light.range = 3;
    scene.lights.push_back(light);
    return scene;
}

RenderResult corner_at(double scale, const Vec3d& shift, uint32_t seed) {
    Scene scene = corner();
    Camera camera = perspective({2.5, -2, 2}, {0, 0, 0.3}, 0.6);
    transform(scene, camera, scale, shift);
    RenderSettings settings = square_settings("mis", camera, 64, 64);
    settings.seed = seed;
    return render_scene(scene, settings);
}

TEST(Invariance, UnderTranslationAndScale) {
    const struct {
        double scale;
        Vec3d shift;
    } cases[] = {{1, {1e3, -1e3, 1e3}}, {1e-4, {0, 0, 0}}, {1e4, {0, 0, 0}}, {1e4, {1e6, 0, -1e6}}, {1e-4, {1, 0, 0}}};
    const Estimate home = image_mean(corner_at(1, {0, 0, 0}, 1));
    uint32_t seed = 2;
    for (const auto& [scale, shift] : cases) {
        SCOPED_TRACE(fmt::format("scale {}, shift ({}, {}, {})", scale, shift[0], shift[1], shift[2]));
        const RenderResult result = corner_at(scale, shift, seed++);
        EXPECT_TRUE(agree(image_mean(result), home, {.tests = 5}));
        // the depth layer stays in metres
        const std::vector<float>& depth = result.film.image.channels.at("depth.Z");
        EXPECT_NEAR(depth[40 * 64 + 32] / scale, corner_at(1, {0, 0, 0}, seed - 1).film.image.channels.at("depth.Z")[40 * 64 + 32], 1e-3);
    }
}

}  // namespace
}  // namespace wavepath
