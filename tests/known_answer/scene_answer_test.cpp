// The known answers that the READMEs of scenes/ state, from the scenes' own files.
#include "build_paths.h"
#include "gltf/gltf_loader.h"
#include "prepare/normalise.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

constexpr const char* channels[] = {"R", "G", "B"};

Scene bundled(const std::string& name) {
    Scene scene = load_gltf(WAVEPATH_SOURCE_DIR "/scenes/" + name + "/scene.gltf");
    scene.environment = constant_environment(1);
    return scene;
}

// Leaves what has this material alone in the scene, and looks at its middle from `above`.
Camera look_at_only(Scene& scene, const std::string& material, double above, double width) {
    std::erase_if(scene.instances, [&](const Instance& instance) {
        return scene.materials[scene.primitives[instance.primitive].material].name != material;
    });
    const Vec3d middle = extent_of(scene).centre;
    return orthographic({middle[0], middle[1], middle[2] + above}, middle, width);
}

TEST(SceneAnswer, Slab) {
    constexpr double truth[] = {.988848, .859035, .420547};
    const Scene scene = bundled("slab");
    const Strictness strictness{.tests = 3, .truth_error = 1e-6};
    const RenderResult result =
        render_for(strictness, scene, square_settings("mis", scene.cameras.at(0), 16, 256), "B");
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_TRUE(has_mean(shared_mean(result, channels[c]), truth[c], strictness))
            << channels[c];
}

TEST(SceneAnswer, Milk) {
    Scene scene = bundled("milk");
    const Camera camera = look_at_only(scene, "milk", 5, 0.01);
    const Strictness strictness{.truth_error = 1e-3};  // a mesh for a ball
    const RenderResult result =
        render_for(strictness, scene, square_settings("mis", camera, 16, 64));
    EXPECT_TRUE(has_mean(shared_mean(result), .991568, strictness));
}

TEST(SceneAnswer, AbsorbingGlass) {
    constexpr double truth[2][3] = {{.165404, .612877, .905213}, {.056892, .384101, .820090}};
    for (std::size_t ball = 0; ball < 2; ++ball) {
        // the darker one shows little but what one path in 25 reflects; meshes for balls
        const Strictness strictness{
            .bias = ball == 0 ? .005 : .01, .tests = 6, .truth_error = 2e-3};
        Scene scene = bundled("absorbing_glass");
        const Camera camera = look_at_only(scene, fmt::format("glass {}", ball + 1), 5, 0.01);
        const RenderResult result =
            render_for(strictness, scene, square_settings("mis", camera, 32, 64));
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_TRUE(has_mean(image_mean(result, channels[c]), truth[ball][c], strictness))
                << ball << ", " << channels[c];
    }
}

// Clear, under an even sky: not there.
TEST(SceneAnswer, GlassOfLiquid) {
    Scene scene = bundled("glass_of_liquid");
    const Camera camera = scene.cameras.at(0);
    std::erase_if(scene.instances, [&](const Instance& instance) {
        const Material& material = scene.materials[scene.primitives[instance.primitive].material];
        return material.boundary == Boundary::opaque;
    });
    ASSERT_GE(scene.instances.size(), 2U);
    for (Material& material : scene.materials) material.medium.sigma_a = {0, 0, 0};
    const Strictness strictness{.truth_error = 1e-6};
    const RenderResult result =
        render_for(strictness, scene, square_settings("mis", camera, 32, 16));
    EXPECT_TRUE(has_mean(image_mean(result), 1, strictness));
}

}  // namespace
}  // namespace wavepath
