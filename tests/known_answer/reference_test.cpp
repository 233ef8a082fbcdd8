// The bundled scenes against another renderer: means of 8 x 8 blocks of 256 x 256 pixels with their
// standard errors, from Mitsuba 3.9 (path or volpath, box filter), in reference/. Block (0, 0) is
// the top left one.
#include "build_paths.h"
#include "gltf/gltf_loader.h"
#include "support/media.h"
#include "support/rendering.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace wavepath {
namespace {

const std::string source = WAVEPATH_SOURCE_DIR;

nlohmann::json reference(const std::string& name) {
    std::ifstream file(source + "/tests/known_answer/reference/" + name + ".json");
    return nlohmann::json::parse(file);
}

struct Comparison {
    Termination termination = {};
    uint32_t size = 256;  // [pixels] of a side
    double whole_bias = 0.01;
};

void expect_same_picture(
    const Scene& scene, const std::string& name, uint64_t samples, const Comparison& how = {}) {
    const nlohmann::json truth = reference(name);
    RenderSettings settings = square_settings("mis", scene.cameras.at(0), how.size, samples);
    settings.termination = how.termination;
    const RenderResult result = render_scene(scene, settings);
    const char* const channels[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<Estimate> blocks = block_image_means(result, channels[c]);
        Estimate whole = {0, 0, truth["batches"].get<double>() - 1};
        for (std::size_t block = 0; block < blocks.size(); ++block) {
            SCOPED_TRACE(fmt::format("{}, block {}, {}", name, block, channels[c]));
            const Estimate theirs = {
                truth["mean"][block / 8][block % 8][c], truth["se"][block / 8][block % 8][c],
                whole.degrees};
            EXPECT_TRUE(agree(blocks[block], theirs, {.bias = 0.25, .tests = 192}));
            whole.mean += theirs.mean / 64;
            whole.error = std::hypot(whole.error, theirs.error / 64);
        }
        SCOPED_TRACE(fmt::format("{}, all of {}", name, channels[c]));
        EXPECT_TRUE(
            agree(image_mean(result, channels[c]), whole, {.bias = how.whole_bias, .tests = 3}));
    }
}

TEST(Reference, CornellBox) {
    expect_same_picture(load_gltf(source + "/scenes/cornell_box/scene.gltf"), "cornell_box", 64);
}

// Direct light alone, which is where a light two centimetres off fails: the rest of the picture
// rests on a few bright paths and would take a hundred times the samples. The edge of the lamp, 400
// times as bright as the room, is what makes the whole noisy even so.
TEST(Reference, BoxLight) {
    expect_same_picture(
        load_gltf(source + "/scenes/box_light/scene.gltf"), "box_light", 256,
        {.termination = {TerminationKind::depth, 1, 1}, .whole_bias = 0.05});
}

// 5.2e8 samples, for a block rests on a few bright paths.
TEST(Reference, BoxLightAllOrders_long) {
    WAVEPATH_SKIP_UNLESS_LONG();
    expect_same_picture(
        load_gltf(source + "/scenes/box_light/scene.gltf"), "box_light_all_orders", 32000,
        {.size = 128});
}

// Fog of albedo 12 / 13 all over the Cornell box and a little beyond, by Mitsuba's volpath.
TEST(Reference, Fog) {
    Scene scene = load_gltf(source + "/scenes/cornell_box/scene.gltf");
    Medium fog;
    fog.sigma_a = grey(0.05F);
    fog.sigma_s = grey(0.6F);
    fog.anisotropy = 0.5F;
    add_box(scene, boundary_of(fog), {-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}, Facing::outward);
    expect_same_picture(scene, "fog", 400, {.size = 128});
}

TEST(Reference, Terrain) {
    Scene scene = load_gltf(WAVEPATH_TERRAIN);
    scene.environment = constant_environment(1);
    scene.environment->radiance = {1.0F, 1.1F, 1.3F};
    expect_same_picture(scene, "terrain", 16);
}

}  // namespace
}  // namespace wavepath
