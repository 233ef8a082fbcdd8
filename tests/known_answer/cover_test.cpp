// Masks and blends: surfaces that cover a part of what is behind them, with closed forms.
#include "support/textured_scenes.h"

#include <cmath>

namespace wavepath {
namespace {

TEST(Masks, LetThroughTheShareOfTheirHoles) {
    std::size_t holes = 0;
    const std::vector<uint8_t> alphas = random_mask(256, holes);
    // a pixel a texel: each is 0 or 1 exactly
    const RenderResult result = render_scene(
        screen(AlphaMode::mask, alphas, 16), depth_limited(above(full_view), 16, 16, 0));
    const std::vector<float>& red = result.film.image.channels.at("R");
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(red[i], alphas[i] < 128 ? 1 : 0) << i;
    EXPECT_NEAR(shared_mean(result).mean, static_cast<double>(holes) / 256, 1e-6);
}

// A point is there where alpha is not below the cutoff [glTF 2.0, section 3.9.4].
TEST(Masks, CoverAtTheCutoff) {
    for (const float alpha : {0.5F, std::nextafter(0.5F, 0.0F)}) {
        Scene scene = scene_named("factor");
        Material material = lambert(grey(0));
        material.alpha_mode = AlphaMode::mask;
        material.alpha_cutoff = 0.5F;
        material.alpha = alpha;
        add_plate(scene, material);
        scene.environment = constant_environment(1);
        const RenderResult result = render_scene(scene, depth_limited(above(1), 2, 4, 0));
        EXPECT_EQ(shared_mean(result).mean, alpha < 0.5F ? 1 : 0);
    }
}

// Through a mask close above a floor a wide sky arrives in the share of the holes, by connections
// and by directions alike. The mask repeats 64 times, so that the floor is even.
TEST(Masks, ShadowAndReflectAlike) {
    std::size_t holes = 0;
    const std::vector<uint8_t> alphas = random_mask(256, holes);
    for (const char* method : {"bsdf", "direct", "mis"}) {
        SCOPED_TRACE(method);
        Scene scene = screen(AlphaMode::mask, alphas, 16);
        scene.environment.reset();
        scene.primitives[0].positions = {-9, -9, 0.5F, 9, -9, 0.5F, 9, 9, 0.5F, -9, 9, 0.5F};
        for (float& uv : scene.primitives[0].uvs[0]) uv *= 600;
        add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.1);
        add_square(scene, lambert(grey(0), grey(1)), {0, 0, 1}, {0, 0, -1}, 1);
        RenderSettings settings =
            square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-2), 16, 256);
        settings.termination = {TerminationKind::depth, 1, 1};
        const RenderResult result = render_for({.bias = 0.01}, scene, settings);
        constexpr double form_factor = .2394564704607735;
        EXPECT_TRUE(has_mean(
            shared_mean(result), form_factor * static_cast<double>(holes) / 256,
            {.bias = 0.01, .truth_error = 2e-3}));
    }
}

// n layers transmit (1 - alpha)^n, without a bounce.
TEST(Blends, TransmitOneMinusAlphaALayer) {
    for (const int layers : {1, 3, 10}) {
        Scene scene = scene_named("layers");
        Material material = lambert(grey(0));
        material.alpha_mode = AlphaMode::blend;
        material.alpha = 0.1F;
        for (int i = 0; i < layers; ++i) add_plate(scene, material, 0.1 * i);
        scene.environment = constant_environment(1);
        const RenderResult result = render_for({}, scene, depth_limited(above(1), 64, 64, 0));
        SCOPED_TRACE(layers);
        EXPECT_TRUE(has_mean(image_mean(result), std::pow(0.9, layers)));
    }
}

// alpha is factor x texture x vertex colour.
TEST(Blends, MultiplyAlphas) {
    Scene scene = screen(AlphaMode::blend, std::vector<uint8_t>(1, 204), 1);  // .8
    scene.materials[0].alpha = 0.5F;
    scene.primitives[0].alphas = {0.25F, 0.25F, 0.75F, 0.75F};  // .5 in the middle row
    const RenderResult result =
        render_for({}, scene, depth_limited(orthographic({0, 0, 3}, {0, 0, 0}, 1e-3), 32, 64, 0));
    EXPECT_TRUE(has_mean(image_mean(result), 1 - 0.8 * 0.5 * 0.5));
}

// A light behind blends, and one that is itself blended: L (1 - alpha)^n arrives, or L alpha.
TEST(Blends, DimLightsAndWhatTheyCover) {
    for (const char* method : {"bsdf", "direct", "mis"})
        for (const int veils : {0, 1, 3}) {
            SCOPED_TRACE(fmt::format("{}, {} veils", method, veils));
            Scene scene = scene_named("dimmed");
            Material light = lambert(grey(0), grey(1));
            if (veils == 0) {
                light.alpha_mode = AlphaMode::blend;
                light.alpha = 0.75F;
            }
            Material veil = lambert(grey(0));
            veil.alpha_mode = AlphaMode::blend;
            veil.alpha = 0.25F;
            for (int i = 0; i < veils; ++i) add_plate(scene, veil, 0.5 + 0.1 * i);
            add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.1);
            add_square(scene, light, {0, 0, 1}, {0, 0, -1}, 1);
            RenderSettings settings =
                square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 32, 64);
            settings.termination = {TerminationKind::depth, 1, 1};
            const Strictness strictness{.bias = 0.01, .tests = 9, .truth_error = 1e-5};
            const RenderResult result = render_for(strictness, scene, settings);
            const double arrives = veils == 0 ? 0.75 : std::pow(0.75, veils);
            EXPECT_TRUE(has_mean(shared_mean(result), arrives * .2394564704607735, strictness));
        }
}

}  // namespace
}  // namespace wavepath
