// Textures of every use with closed forms.
#include "support/media.h"
#include "support/textured_scenes.h"

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

namespace wavepath {
namespace {

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

// Roughness, metallic and specular from textures are those of factors, to the digits of 16 bits.
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

// Irradiance / pi from a strip y = -0.5 .. 0.5 at height 1, x = near .. far from the receiver: of
// parallel rectangles [Howell 2011, C-11].
double strip_factor(double near, double far) {
    const auto corner = [](double x) {
        constexpr double y = 0.5;
        const double along_x = std::sqrt(1 + x * x);
        const double along_y = std::sqrt(1 + y * y);
        return x / along_x * std::atan(y / along_x) + y / along_y * std::atan(x / along_y);
    };
    return (corner(far) - corner(near)) / std::numbers::pi;
}

// Half of the light shines, and the receiver lies below the light's edge: which half matters.
TEST(EmissionTextures, LightByWhatTheyShow) {
    const Strictness strictness{.bias = 0.01, .tests = 16, .truth_error = 1e-5};
    for (const std::string method : {"bsdf", "direct", "mis", "mis in fog"})
        for (const LightChoice choice : {LightChoice::area, LightChoice::power})
            for (const bool first_half : {true, false}) {
                SCOPED_TRACE(fmt::format("{}, first half {}", method, first_half));
                Scene scene = scene_named("half a light");
                add_square(scene, lambert(grey(1)), {0.5, 0, 0}, {0, 0, 1}, 0.1);
                Primitive& light =
                    add_square(scene, lambert(grey(0), grey(2)), {0, 0, 1}, {0, 0, -1}, 1);
                for (std::size_t corner = 0; corner < 4; ++corner) {
                    light.uvs[0].push_back(light.positions[3 * corner] + 0.5F);
                    light.uvs[0].push_back(0.5F);
                }
                const uint8_t first = first_half ? 255 : 0;
                const auto second = static_cast<uint8_t>(255 - first);
                add_texture(
                    scene, scene.materials[1], TEXTURE_EMISSION,
                    image_of(2, 1, {first, first, first, 255, second, second, second, 255}))
                    .nearest = true;
                // too thin to be seen, but there light points are chosen by solid angle
                const bool in_fog = method == "mis in fog";
                if (in_fog)
                    add_box(
                        scene, boundary_of(medium_of(1e-6, 1)), {-2, -2, -2}, {2, 2, 2},
                        Facing::outward);
                RenderSettings settings = square_settings(
                    in_fog ? "mis" : method, close_up({0.5, 0, 0}, {0, 0, 1}, 0.1, 2e-3), 16, 256);
                settings.method.light_choice = choice;
                const double truth = 2 * (first_half ? strip_factor(0.5, 1) : strip_factor(0, 0.5));
                const RenderResult result = render_for(strictness, scene, settings);
                EXPECT_EQ(result.guided, in_fog);
                EXPECT_TRUE(has_mean(shared_mean(result), truth, strictness));
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

TEST(Textures, AreTheSameInTwoPools) {
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

// A device that gives no buffer of more than 400 KiB takes a picture of 1 MiB in three pages.
TEST(Textures, AreTheSameInOnePageAndInThree) {
    Scene scene = everything();
    std::mt19937 random(3);
    std::vector<uint8_t> rgba(std::size_t{4} * 512 * 512);
    for (uint8_t& code : rgba) code = static_cast<uint8_t>(random() % 256);
    add_plate(scene, lambert(grey(1)), -1.5);
    add_texture(scene, scene.materials.back(), TEXTURE_BASE_COLOR, image_of(512, 512, rgba)).srgb =
        true;
    RenderSettings settings =
        square_settings("mis", perspective({0, 0.5, 4}, {0, 0, 0}, 0.7), 31, 5);
    settings.pool = 500;
    const RenderResult whole = render_scene(scene, settings);
    Device small = test_device();
    small.info.max_allocation = 400U << 10U;
    const RenderResult paged = render(small, scene, settings);
    EXPECT_EQ(whole.texture_pages, 1U);
    EXPECT_EQ(paged.texture_pages, 3U);
    EXPECT_GT(whole.texture_bytes, 1U << 20U);
    EXPECT_LT(whole.texture_bytes, 1100U << 10U);
    expect_same_bits(whole, paged);
}

}  // namespace
}  // namespace wavepath
