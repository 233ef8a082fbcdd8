// Textures, holes and normal maps with closed forms.
#include "scene/tangents.h"
#include "support/images.h"
#include "support/rendering.h"

#include <cmath>
#include <cstring>
#include <random>

namespace wavepath {
namespace {

constexpr double full_view = 2;  // of the plate below

// A plate of 2 x 2 in the plane z = `z` whose picture stands upright seen from +z.
Primitive& add_plate(Scene& scene, const Material& material, double z = 0) {
    Primitive& plate = add_quad(scene, material, {-1, -1, z}, {2, 0, 0}, {0, 2, 0});
    plate.uvs[0] = {0, 1, 1, 1, 1, 0, 0, 0};
    return plate;
}

Camera above(double side) {
    return orthographic({0, 0, 3}, {0, 0, 0}, side);
}

RenderSettings depth_limited(
    const Camera& camera, uint32_t size, uint64_t samples, uint32_t depth) {
    RenderSettings settings = square_settings("mis", camera, size, samples);
    settings.termination = {TerminationKind::depth, depth, 1};
    return settings;
}

// u runs from texel centre to texel centre: the image 0, 1 interpolates linearly between them, and
// the mean over a pixel is the value at its middle.
TEST(Textures, ShowTheMeanOfAGradientOverAPixel) {
    Scene scene = scene_named("gradient");
    add_plate(scene, lambert(grey(1)));
    Texture& texture = add_texture(
        scene, scene.materials[0], TEXTURE_BASE_COLOR,
        image_of(2, 1, {0, 0, 0, 255, 255, 255, 255, 255}));
    texture.transform = {0.5F, 0, 0.25F, 0, 1, 0};
    scene.environment = constant_environment(1);
    const RenderResult result = render_scene(scene, depth_limited(above(full_view), 8, 4096, 1));
    const std::vector<float>& red = result.film.image.channels.at("R");
    const std::vector<float>& albedo = result.film.image.channels.at("albedo.R");
    for (std::size_t i = 0; i < red.size(); ++i) {
        const double middle = (static_cast<double>(i % 8) + 0.5) / 8;
        // 4096 stratified columns: off by 1 / 4096 of the pixel's own range
        EXPECT_NEAR(albedo[i], middle, 1e-4) << i;
        EXPECT_NEAR(red[i], middle, 1e-4) << i;
    }
}

TEST(Textures, MultiplyFactorsAndVertexColours) {
    Scene scene = scene_named("product");
    Primitive& plate = add_plate(scene, lambert({0.5F, 1, 1}));
    plate.colors = std::vector<float>(12, 0.25F);
    // 188 is .5 of the sRGB curve to 3 digits: ((188/255 + .055)/1.055)^2.4
    add_texture(scene, scene.materials[0], TEXTURE_BASE_COLOR, image_of(1, 1, {188, 255, 0, 255}))
        .srgb = true;
    scene.environment = constant_environment(1);
    const RenderResult result = render_scene(scene, depth_limited(above(1), 4, 16, 1));
    const double half = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(result.film.image.channels.at("R")[0], 0.125 * half, 1e-6);
    EXPECT_NEAR(result.film.image.channels.at("G")[0], 0.25, 1e-6);
    EXPECT_EQ(result.film.image.channels.at("B")[0], 0);
}

// Roughness, metallic and specular from textures are those of factors, bit for bit.
TEST(Textures, OfLobesAreTheirFactors) {
    const Material factors = [] {
        Material m = dielectric({0.8F, 0.6F, 0.4F}, 0.5F);
        m.metallic = 0.25F;
        m.specular = 0.5F;
        m.specular_color = {0.5F, 0.25F, 1};
        return m;
    }();
    const auto rendered = [&](bool textured) {
        Scene scene = scene_named("lobes");
        Material material = factors;
        if (textured) {
            material.roughness = 1;
            material.metallic = 1;
            material.specular = 1;
            material.specular_color = {1, 1, 1};
        }
        add_plate(scene, material);
        add_square(scene, lambert(grey(0), grey(5)), {0, 0, 2}, {0, 0, -1}, 1);
        if (textured) {
            Material& m = scene.materials[0];
            // codes of 1/2 and 1/4 to 16 bits
            add_texture(
                scene, m, TEXTURE_METALLIC_ROUGHNESS, texel_image(0, 32768.0 / 65535, 0.25));
            add_texture(scene, m, TEXTURE_SPECULAR, texel_image(0, 0, 0, 32768.0 / 65535));
            add_texture(scene, m, TEXTURE_SPECULAR_COLOR, texel_image(0.5, 0.25, 1));
        }
        RenderSettings settings =
            depth_limited(perspective({1, 0.3, 1}, {0, 0, 0}, 0.8), 16, 64, 1);
        return render_scene(scene, settings);
    };
    const std::vector<float> a = rendered(false).film.image.channels.at("R");
    const std::vector<float> b = rendered(true).film.image.channels.at("R");
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(b[i], a[i], 3e-4 * a[i]) << i;
}

// A black plate with holes before a sky of radiance 1 shows the share of its holes; `opaque` texels
// of 16.
Scene screen(AlphaMode mode, const std::vector<uint8_t>& alphas, uint32_t width) {
    Scene scene = scene_named("screen");
    Material material = lambert(grey(0));
    material.alpha_mode = mode;
    material.alpha_cutoff = 0.5F;
    add_plate(scene, material);
    std::vector<uint8_t> rgba;
    for (const uint8_t a : alphas) rgba.insert(rgba.end(), {255, 255, 255, a});
    add_texture(
        scene, scene.materials[0], TEXTURE_BASE_COLOR,
        image_of(width, static_cast<uint32_t>(alphas.size()) / width, rgba))
        .nearest = true;
    scene.environment = constant_environment(1);
    return scene;
}

std::vector<uint8_t> random_mask(std::size_t texels, std::size_t& holes) {
    std::mt19937 random(5);
    std::vector<uint8_t> alphas(texels);
    holes = 0;
    for (uint8_t& a : alphas) {
        a = random() % 3 == 0 ? 127 : 128;  // just below the cutoff and just above
        holes += a < 128 ? 1 : 0;
    }
    return alphas;
}

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

// A light behind a blend, and one that is itself blended: L alpha arrives, or L (1 - alpha).
TEST(Blends, DimLightsAndWhatTheyCover) {
    for (const char* method : {"bsdf", "direct", "mis"})
        for (const bool light_itself : {false, true}) {
            SCOPED_TRACE(fmt::format("{}, the light itself: {}", method, light_itself));
            Scene scene = scene_named("dimmed");
            Material light = lambert(grey(0), grey(1));
            if (light_itself) {
                light.alpha_mode = AlphaMode::blend;
                light.alpha = 0.75F;
            } else {
                Material veil = lambert(grey(0));
                veil.alpha_mode = AlphaMode::blend;
                veil.alpha = 0.25F;
                add_plate(scene, veil, 0.5);
            }
            add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.1);
            add_square(scene, light, {0, 0, 1}, {0, 0, -1}, 1);
            RenderSettings settings =
                square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 32, 64);
            settings.termination = {TerminationKind::depth, 1, 1};
            const RenderResult result = render_for({}, scene, settings);
            EXPECT_TRUE(
                has_mean(shared_mean(result), 0.75 * .2394564704607735, {.truth_error = 1e-5}));
        }
}

// Left half 1, right half 0: F of the left half by symmetry is half of the whole.
TEST(EmissionTextures, LightByWhatTheyShow) {
    for (const char* method : {"bsdf", "direct", "mis"})
        for (const LightChoice choice : {LightChoice::area, LightChoice::power}) {
            SCOPED_TRACE(method);
            Scene scene = scene_named("half a light");
            add_square(scene, lambert(grey(1)), {0, 0, 0}, {0, 0, 1}, 0.1);
            Primitive& light =
                add_square(scene, lambert(grey(0), grey(2)), {0, 0, 1}, {0, 0, -1}, 1);
            light.uvs[0] = {0, 0, 1, 0, 1, 1, 0, 1};
            add_texture(
                scene, scene.materials[1], TEXTURE_EMISSION,
                image_of(2, 1, {255, 255, 255, 255, 0, 0, 0, 255}))
                .nearest = true;
            RenderSettings settings =
                square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 16, 256);
            settings.method.light_choice = choice;
            const RenderResult result = render_for({}, scene, settings);
            EXPECT_TRUE(has_mean(shared_mean(result), .2394564704607735, {.truth_error = 1e-5}));
        }
}

// Unlit: radiance is the colour, from either side, and nothing is reflected.
TEST(Unlit, ShowsItsColour) {
    for (const double z : {3.0, -3.0}) {
        Scene scene = scene_named("unlit");
        Material material = lambert(grey(0), {0.5F, 1, 1}, true);
        material.unlit = true;
        add_plate(scene, material).colors = std::vector<float>(12, 0.5F);
        scene.environment = constant_environment(7);
        const RenderResult result = render_scene(
            scene, square_settings("mis", orthographic({0, 0, z}, {0, 0, 0}, 1), 4, 16));
        for (const float x : result.film.image.channels.at("R")) EXPECT_EQ(x, 0.25F);
        for (const float x : result.film.image.channels.at("G")) EXPECT_EQ(x, 0.5F);
    }
}

// A smooth sphere with a normal map whose texels are `codes` over its longitudes and latitudes.
Scene bumpy_sphere(const Material& material, TextureImage image) {
    Scene scene = scene_named("bumpy sphere");
    Primitive& sphere = add_icosphere(scene, material, {0, 0, 0}, 1, 3);
    sphere.normals = sphere.positions;
    for (std::size_t i = 0; i < sphere.positions.size(); i += 3) {
        const float* p = &sphere.positions[i];
        sphere.uvs[0].push_back(2 * p[0] + p[2]);
        sphere.uvs[0].push_back(2 * p[1] - p[2]);
    }
    add_texture(scene, scene.materials[0], TEXTURE_NORMAL, std::move(image));
    sphere.tangents = derive_tangents(sphere, sphere.uvs[0]);
    scene.environment = constant_environment(1);
    return scene;
}

TextureImage steep_bumps() {
    std::mt19937 random(11);
    std::vector<uint8_t> rgba;
    for (int i = 0; i < 64; ++i)
        rgba.insert(
            rgba.end(), {static_cast<uint8_t>(random() % 256), static_cast<uint8_t>(random() % 256),
                         static_cast<uint8_t>(140 + random() % 116), 255});
    return image_of(8, 8, rgba);
}

// No light is lost at a tilted lobe and none gained: white Lambert under a uniform sky shows 1 at
// every pixel, whatever its normals say.
TEST(NormalMaps, KeepTheFurnaceWhite) {
    for (const char* method : {"path", "bsdf", "direct", "mis"}) {
        SCOPED_TRACE(method);
        const bool by_points = std::string(method) == "direct";
        RenderSettings settings = square_settings(
            method, orthographic({0, 0, 3}, {0, 0, 0}, 1.2), 64, by_points ? 256 : 4);
        settings.termination = {TerminationKind::depth, 1, 1};
        const RenderResult result =
            render_scene(bumpy_sphere(lambert(grey(1)), steep_bumps()), settings);
        EXPECT_TRUE(has_mean(shared_mean(result), 1));
    }
}

// A code of neither 0 nor 255 is the middle exactly in 16 bits only to 1 / 65535: the normal stays
// the vertices' to that.
TEST(NormalMaps, OfTheMiddleChangeNothing) {
    const auto normals = [](TextureImage image, float scale) {
        Scene scene = bumpy_sphere(lambert(grey(0.5F)), std::move(image));
        scene.materials[0].normal_scale = scale;
        return render_scene(
            scene, depth_limited(orthographic({0, 0, 3}, {0, 0, 0}, 1.2), 32, 4, 0));
    };
    const RenderResult middle = normals(texel_image(0.5, 0.5, 1), 1);
    const RenderResult flat = normals(steep_bumps(), 0);
    Scene scene = bumpy_sphere(lambert(grey(0.5F)), texel_image(0.5, 0.5, 1));
    scene.materials[0].textures[TEXTURE_NORMAL] = {};
    scene.primitives[0].tangents.clear();
    const RenderResult plain =
        render_scene(scene, depth_limited(orthographic({0, 0, 3}, {0, 0, 0}, 1.2), 32, 4, 0));
    for (const char* channel : {"normal.X", "normal.Y", "normal.Z"})
        for (std::size_t i = 0; i < 32 * 32; ++i) {
            const float expected = plain.film.image.channels.at(channel)[i];
            EXPECT_NEAR(middle.film.image.channels.at(channel)[i], expected, 5e-5);
            EXPECT_NEAR(flat.film.image.channels.at(channel)[i], expected, 1e-6);
        }
}

// (1, 0.5, 0.5) tilts all the way to the tangent: a plate whose u runs along x sees +x; v runs
// down.
TEST(NormalMaps, TiltAlongUAndUp) {
    const auto tilted = [](double r, double g, double b) {
        Scene scene = scene_named("tilted");
        Primitive& plate = add_plate(scene, lambert(grey(1)));
        add_texture(scene, scene.materials[0], TEXTURE_NORMAL, texel_image(r, g, b));
        plate.tangents = derive_tangents(plate, plate.uvs[0]);
        scene.environment = constant_environment(1);
        return render_scene(scene, depth_limited(above(1), 2, 1, 0)).film.image.channels;
    };
    auto right = tilted(0.8, 0.5, 0.9);
    EXPECT_NEAR(right.at("normal.X")[0], 0.6, 1e-4);
    EXPECT_NEAR(right.at("normal.Y")[0], 0, 1e-4);
    EXPECT_NEAR(right.at("normal.Z")[0], 0.8, 1e-4);
    auto up = tilted(0.5, 0.8, 0.9);
    EXPECT_NEAR(up.at("normal.Y")[0], 0.6, 1e-4);
}

// The furnace of furnace_test.cpp with walls of textured albedo, behind inner screens of white
// masks and veils: L = Le / (1 - rho) where every wall and screen emits and reflects alike.
TEST(Textures, KeepTheFurnace) {
    Scene scene = scene_named("textured furnace");
    Material wall = lambert(grey(1), grey(1), true);
    Primitive& box = add_box(scene, wall, {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    box.uvs[0] = std::vector<float>(16, 0.5F);
    add_texture(scene, scene.materials[0], TEXTURE_BASE_COLOR, texel_image(0.5, 0.8, 0.25));
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        Material screen = wall;
        screen.alpha_mode = mode;
        screen.alpha_cutoff = 0.5F;
        Primitive& inner = add_square(
            scene, screen, {0, 0, mode == AlphaMode::mask ? -0.3 : 0.2}, {0.2, 0.1, 1}, 1);
        inner.uvs[0] = {0, 0, 3, 0, 3, 3, 0, 3};
        TextureImage image = texel_image(0.5, 0.8, 0.25, 0.4);
        image.width = 2;
        for (const uint32_t word : texel_image(0.5, 0.8, 0.25, 1).words)
            image.words.push_back(word);
        add_texture(scene, scene.materials.back(), TEXTURE_BASE_COLOR, std::move(image)).nearest =
            true;
    }
    for (const char* method : {"path", "mis"}) {
        SCOPED_TRACE(method);
        const RenderResult result = render_scene(
            scene,
            square_settings(method, perspective({0.2, 0.1, 0.9}, {-0.3, -0.1, -0.9}, 1.6), 32, 96));
        EXPECT_TRUE(has_mean(shared_mean(result, "R"), 2, {.bias = 0.01, .truth_error = 2e-5}));
        EXPECT_TRUE(
            has_mean(shared_mean(result, "B"), 4.0 / 3, {.bias = 0.01, .truth_error = 2e-5}));
        EXPECT_TRUE(has_mean(shared_mean(result, "G"), 5, {.bias = 0.02, .truth_error = 1e-4}));
    }
}

Scene everything() {
    Scene scene = bumpy_sphere(metal(grey(0.8F), 1), steep_bumps());
    add_texture(scene, scene.materials[0], TEXTURE_METALLIC_ROUGHNESS, texel_image(0, 0.5, 0.5));
    std::size_t holes = 0;
    const Scene mask = screen(AlphaMode::mask, random_mask(256, holes), 16);
    const Scene veil = screen(AlphaMode::blend, std::vector<uint8_t>(1, 128), 1);
    for (const Scene* part : {&mask, &veil}) {
        Material material = part->materials[0];
        material.base_color = grey(0.7F);
        Primitive& plate = add_plate(scene, material, part == &mask ? 1.5 : 1.7);
        add_texture(scene, scene.materials.back(), TEXTURE_BASE_COLOR, part->images[0]);
        plate.uvs[0] = {0, 0, 2, 0, 2, 2, 0, 2};
    }
    add_square(scene, lambert(grey(0), grey(3)), {0, 2, 2}, {0, -1, -1}, 1);
    return scene;
}

void expect_same_bits(const RenderResult& a, const RenderResult& b) {
    for (const auto& [name, plane] : a.film.image.channels)
        EXPECT_EQ(
            std::memcmp(
                plane.data(), b.film.image.channels.at(name).data(), plane.size() * sizeof(float)),
            0)
            << name;
}

TEST(Textures, AreTheSameInTwoPoolsAndPages) {
    RenderSettings settings =
        square_settings("mis", perspective({0, 0.5, 4}, {0, 0, 0}, 0.7), 31, 5);
    const RenderResult first = render_scene(everything(), settings);
    expect_same_bits(first, render_scene(everything(), settings));
    settings.pool = 100;
    expect_same_bits(first, render_scene(everything(), settings));
    settings.work_groups = {16, 64};
    settings.splits.reflections = 2;
    const RenderResult split = render_scene(everything(), settings);
    settings.pool = 0;
    expect_same_bits(split, render_scene(everything(), settings));
}

}  // namespace
}  // namespace wavepath
