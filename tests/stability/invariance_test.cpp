// Where a scene lies and how large it is must not show.
#include "build_paths.h"
#include "gltf/gltf_loader.h"
#include "support/rendering.h"
#include "support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <fstream>

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

RenderResult corner_at(double scale, const Vec3d& shift) {
    Scene scene = corner();
    Camera camera = perspective({1.8, -1.4, 1.3}, {0, 0, 0.3}, 0.6);
    transform(scene, camera, scale, shift);
    return render_scene(scene, square_settings("mis", camera, 64, 16));
}

// The same random numbers in both pictures: what differs is rounding, which turns a path here and
// there.
void expect_same_mean(const RenderResult& home, const RenderResult& away, std::size_t tests) {
    const std::vector<float>& before = home.film.image.channels.at("R");
    const std::vector<float>& after = away.film.image.channels.at("R");
    const double mean = image_mean(home).mean;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < after.size(); ++i)
        ratios.push_back(1 + (after[i] - before[i]) / mean);
    EXPECT_TRUE(has_mean(estimate_of(ratios), 1, {.tests = tests}));
}

TEST(Invariance, UnderTranslationAndScale) {
    const struct {
        double scale;
        Vec3d shift;
    } cases[] = {
        {1, {1e3, -1e3, 1e3}},
        {1e-4, {0, 0, 0}},
        {1e4, {0, 0, 0}},
        {1e4, {1e6, 0, -1e6}},
        {1e-4, {1, 0, 0}}};
    const RenderResult home = corner_at(1, {0, 0, 0});
    for (const auto& [scale, shift] : cases) {
        SCOPED_TRACE(
            fmt::format("scale {}, shift ({}, {}, {})", scale, shift[0], shift[1], shift[2]));
        const RenderResult result = corner_at(scale, shift);
        expect_same_mean(home, result, 5);
        // the depth layer stays in metres
        constexpr std::size_t middle = 32 * 64 + 32;
        const double depth = result.film.image.channels.at("depth.Z")[middle];
        EXPECT_NEAR(depth / scale, home.film.image.channels.at("depth.Z")[middle], 1e-3);
    }
}

// The same through a file: a node above all others moves them, the camera too.
TEST(Invariance, UnderANodeThatMovesTheWholeFile) {
    const std::string path = WAVEPATH_SOURCE_DIR "/scenes/cornell_box/scene.gltf";
    std::ifstream file(path);
    nlohmann::json gltf = nlohmann::json::parse(file);
    gltf["nodes"].push_back(
        {{"translation", {1e3, -1e3, 1e3}}, {"children", gltf["scenes"][0]["nodes"]}});
    gltf["scenes"][0]["nodes"] = {gltf["nodes"].size() - 1};
    const TemporaryFolder folder;
    const std::filesystem::path moved = folder.write("moved.gltf", gltf.dump());
    const auto rendered = [](const Scene& scene) {
        return render_scene(scene, square_settings("mis", scene.cameras.at(0), 64, 16));
    };
    expect_same_mean(rendered(load_gltf(path)), rendered(load_gltf(moved)), 1);
}

}  // namespace
}  // namespace wavepath
