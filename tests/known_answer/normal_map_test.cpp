// Normal maps with closed forms.
#include "scene/tangents.h"
#include "support/textured_scenes.h"

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

}  // namespace
}  // namespace wavepath
