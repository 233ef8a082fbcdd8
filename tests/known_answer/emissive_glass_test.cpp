// Bodies that emit and let light through, on a floor before a wall: all methods see one picture.
#include "gltf/gltf_loader.h"
#include "support/case_files.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

// The methods find the body's light by points of it, by directions, or by both.
class EmissiveGlass : public testing::TestWithParam<const char*> {};

TEST_P(EmissiveGlass, IsTheSameByEveryMethod) {
    const auto folder = case_folder("emissive-glass");
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    const Scene scene = load_gltf(folder / (std::string(GetParam()) + ".gltf"));
    const auto expect_agreement = [&](const Camera& camera,
                                      const std::vector<const char*>& methods) {
        constexpr double bias = 0.04;
        const auto seen = [&](const char* method) {
            return image_mean(render_for(
                {.bias = bias / 1.5, .tests = 3}, scene, square_settings(method, camera, 16, 64)));
        };
        const Estimate mis = seen("mis");
        EXPECT_GT(mis.mean, 0.01);
        for (const char* method : methods)
            EXPECT_TRUE(agree(seen(method), mis, {.bias = bias, .tests = 3})) << method;
    };
    // the body, and the floor that it lights
    expect_agreement(perspective({0, 1.2, 4}, {0, 0.8, 0}, 0.3), {"bsdf"});
    expect_agreement(perspective({0, 2, 4}, {1, 0, 0.5}, 0.2), {"bsdf", "direct-bsdf"});
}

INSTANTIATE_TEST_SUITE_P(
    Files,
    EmissiveGlass,
    testing::Values(
        "black",
        "blend",
        "blend_double",
        "glass_absorbing",
        "glass_rough",
        "glass_smooth",
        "glass_smooth_double",
        "metal",
        "opaque",
        "thin_half",
        "thin_rough",
        "thin_rough_double",
        "thin_smooth"),
    [](const testing::TestParamInfo<const char*>& file) { return std::string(file.param); });

}  // namespace
}  // namespace wavepath
