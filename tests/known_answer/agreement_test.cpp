// Estimators of one picture: every method that can see the light has the same mean.
#include "support/rendering.h"

namespace wavepath {
namespace {

// A box with coloured walls, a broad light that no wall touches, a matt block and a glossy one.
Scene room() {
    Scene scene = scene_named("room");
    add_quad(scene, lambert(grey(0.7F)), {0, 0, 0}, {0, 0, 1}, {1, 0, 0});          // floor
    add_quad(scene, lambert(grey(0.7F)), {0, 1, 0}, {1, 0, 0}, {0, 0, 1});          // ceiling
    add_quad(scene, lambert(grey(0.7F)), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});          // back
    add_quad(scene, lambert({0.6F, 0.1F, 0.1F}), {0, 0, 0}, {0, 1, 0}, {0, 0, 1});  // left
    add_quad(scene, lambert({0.1F, 0.5F, 0.1F}), {1, 0, 0}, {0, 0, 1}, {0, 1, 0});  // right
    add_box(scene, lambert(grey(0.6F)), {0.15, 0.02, 0.2}, {0.4, 0.5, 0.45}, Facing::outward);
    add_box(
        scene, metal({0.9F, 0.7F, 0.4F}, 0.5F), {0.55, 0.02, 0.4}, {0.85, 0.3, 0.7},
        Facing::outward);
    add_quad(scene, lambert(grey(0), grey(4)), {0.05, 0.95, 0.05}, {0.9, 0, 0}, {0, 0, 0.9});
    return scene;
}

const Camera at_the_door = perspective({0.5, 0.5, 2.2}, {0.5, 0.5, 0}, 0.75);

TEST(Agreement, OfAllMethodsThatSeeTheLight) {
    const auto render_with = [](const char* method, double bias) {
        RenderSettings settings = square_settings(method, at_the_door, 64, 128);
        settings.seed = static_cast<uint32_t>(std::string(method).size());
        return render_for({.bias = bias, .tests = 12}, room(), settings, "G");
    };
    const RenderResult mis = render_with("mis", 0.002);
    for (const char* method : {"path", "bsdf", "direct", "direct-bsdf"}) {
        const RenderResult other = render_with(method, 0.0042);
        for (const char* channel : {"R", "G", "B"}) {
            SCOPED_TRACE(fmt::format("{}, {}", method, channel));
            EXPECT_TRUE(agree(
                image_mean(mis, channel), image_mean(other, channel),
                {.bias = 0.005, .tests = 12}));
        }
    }
}

// Two lights of unequal area and radiance: choosing by area or by power changes the noise and
// nothing else.
TEST(Agreement, OfLightChoices) {
    Scene scene = scene_named("two lights");
    add_square(scene, lambert(grey(0.5F)), {0, 0, 0}, {0, 0, 1}, 4);
    add_square(scene, lambert(grey(0), {8, 1, 1}), {-0.5, 0, 1}, {0, 0, -1}, 0.2);
    add_square(scene, lambert(grey(0), {0.5F, 1, 1}, true), {0.6, 0.2, 1.2}, {0, 0, -1}, 0.7);
    const Camera camera = close_up({0.1, 0, 0}, {0, 0, 1}, 0.1, 1e-3);
    std::vector<RenderResult> results;
    for (const char* name : {"direct", "mis"}) {
        for (const LightChoice choice : {LightChoice::area, LightChoice::power}) {
            RenderSettings settings = square_settings(name, camera, 16, 256);
            settings.method.light_choice = choice;
            settings.seed = static_cast<uint32_t>(results.size() + 1);
            results.push_back(render_for({.bias = 0.007, .tests = 12}, scene, settings));
        }
    }
    for (std::size_t a = 0; a < results.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            SCOPED_TRACE(fmt::format("runs {} and {}", a, b));
            for (const char* channel : {"R", "G"})
                EXPECT_TRUE(agree(
                    shared_mean(results[a], channel), shared_mean(results[b], channel),
                    {.bias = 0.01, .tests = 12}));
        }
    }
}

}  // namespace
}  // namespace wavepath
