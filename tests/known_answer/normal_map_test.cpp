// Normal maps with closed forms.
#include "gltf/tangents.h"
#include "support/textured_scenes.h"

#include <gmock/gmock.h>

#include <array>

namespace wavepath {
namespace {

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
        for (std::size_t i = 0; i < std::size_t{32} * 32; ++i) {
            const float expected = plain.film.image.channels.at(channel)[i];
            EXPECT_NEAR(middle.film.image.channels.at(channel)[i], expected, 5e-5);
            EXPECT_NEAR(flat.film.image.channels.at(channel)[i], expected, 1e-6);
        }
}

// Normals of a plate whose u runs along x and v down, under a map of one texel.
std::array<double, 3> mapped(
    const std::array<double, 3>& texel, const Vec3d& scale = {1, 1, 1}, double eye = 3) {
    Scene scene = scene_named("tilted");
    Primitive& plate = add_plate(scene, lambert(grey(1)));
    add_texture(
        scene, scene.materials[0], TEXTURE_NORMAL, texel_image(texel[0], texel[1], texel[2]));
    plate.tangents = derive_tangents(plate, plate.uvs[0]);
    for (std::size_t k = 0; k < 3; ++k) scene.instances[0].to_world[5 * k] = scale[k];
    scene.environment = constant_environment(1);
    const Camera camera = orthographic({0, 0, eye}, {0, 0, 0}, 1);
    const RenderResult result = render_scene(scene, depth_limited(camera, 2, 1, 0));
    const auto channel = [&](const char* name) {
        return double{result.film.image.channels.at(name)[0]};
    };
    return {channel("normal.X"), channel("normal.Y"), channel("normal.Z")};
}

auto near(double x, double y, double z) {
    constexpr double off = 1e-4;
    return testing::ElementsAre(
        testing::DoubleNear(x, off), testing::DoubleNear(y, off), testing::DoubleNear(z, off));
}

constexpr std::array<double, 3> right{0.8, 0.5, 0.9};  // (.6, 0, .8)
constexpr std::array<double, 3> up{0.5, 0.8, 0.9};     // (0, .6, .8)

TEST(NormalMaps, TiltAlongUAndUp) {
    EXPECT_THAT(mapped(right), near(0.6, 0, 0.8));
    EXPECT_THAT(mapped(up), near(0, 0.6, 0.8));
}

// What is painted on a plate turns with it, mirrored or not.
TEST(NormalMaps, AreMirroredWithTheirNodes) {
    EXPECT_THAT(mapped(right, {-1, 1, 1}), near(-0.6, 0, 0.8));
    EXPECT_THAT(mapped(up, {-1, 1, 1}), near(0, 0.6, 0.8));
    EXPECT_THAT(mapped(right, {1, -1, 1}), near(0.6, 0, 0.8));
    EXPECT_THAT(mapped(up, {1, -1, 1}), near(0, -0.6, 0.8));
    EXPECT_THAT(mapped(up, {-1, -1, 1}), near(0, -0.6, 0.8));
}

// A back's normal is the front's, turned round [glTF 2.0, section 3.9.5].
TEST(NormalMaps, OfTheBackAreTheFrontsTurnedRound) {
    EXPECT_THAT(mapped(right, {1, 1, 1}, -3), near(-0.6, 0, -0.8));
    EXPECT_THAT(mapped(up, {1, 1, 1}, -3), near(0, -0.6, -0.8));
}

// A mirror under a map shows the whole sky, folded back where a normal would send it through.
TEST(NormalMaps, OfMirrorsKeepTheFurnaceWhite) {
    RenderSettings settings =
        square_settings("mis", orthographic({0, 0, 3}, {0, 0, 0}, 1.2), 64, 4);
    settings.termination = {TerminationKind::depth, 1, 1};
    const RenderResult result =
        render_scene(bumpy_sphere(metal(grey(1), 0), steep_bumps()), settings);
    EXPECT_NEAR(shared_mean(result).mean, 1, 1e-5);
}

// Lobes of metal under maps: one picture by directions of the bsdf and by points on a lamp.
TEST(NormalMaps, OfMetalAreTheSameInEveryMethod) {
    for (const float roughness : {0.3F, 1.0F}) {
        SCOPED_TRACE(roughness);
        Scene scene = bumpy_sphere(metal(grey(1), roughness), steep_bumps());
        scene.environment.reset();
        add_square(scene, lambert(grey(0), grey(1)), {1, 1, 3}, {-1, -1, -3}, 4);
        const auto mean = [&](const char* method) {
            RenderSettings settings =
                square_settings(method, orthographic({0, 0, 2}, {0, 0, 0}, 1.2), 32, 16);
            settings.termination = {TerminationKind::depth, 1, 1};
            return image_mean(render_for({.bias = 0.01 / 1.5, .tests = 2}, scene, settings));
        };
        const char* other = roughness < 1 ? "bsdf" : "direct";  // whose noise is less
        EXPECT_TRUE(agree(mean("mis"), mean(other), {.bias = 0.01, .tests = 2}));
    }
}

}  // namespace
}  // namespace wavepath
