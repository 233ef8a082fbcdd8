// Two instances of a mesh, of which one is mirrored by a negative scale, in a room that is its own
// mirror image: so is its picture.
#include "gltf/gltf_loader.h"
#include "support/case_files.h"
#include "support/rendering.h"

namespace wavepath {
namespace {

// A winding that is not turned with its mesh would have the lamp shine upwards, glass and fog be
// inside out, and metal black.
class MirroredInstances : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        const auto folder = case_folder("mirrored-instances");
        if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
        scene_ = load_gltf(folder / (std::string(GetParam()) + ".gltf"));
        if (std::string(GetParam()) != "lamp") scene_.environment = constant_environment(1);
    }

    RenderResult seen_by(const Camera& camera, double bias) const {
        return render_for({.bias = bias}, scene_, square_settings("mis", camera, 32, 256));
    }

    Scene scene_;
};

TEST_P(MirroredInstances, HaveAPictureThatIsItsMirrorImage) {
    const RenderResult result = seen_by(perspective({0, 1.5, 6}, {0, 1, 0}, 0.8), 0.005);
    for (const char* channel : {"R", "G", "B"}) {
        const std::vector<Estimate> blocks = block_image_means(result, channel);
        for (std::size_t row = 0; row < 8; ++row)
            for (std::size_t column = 0; column < 4; ++column)
                EXPECT_TRUE(agree(
                    blocks[8 * row + column], blocks[8 * row + 7 - column],
                    {.bias = 0.5, .tests = 96}))
                    << channel << ", row " << row << ", column " << column;
    }
}

// From the middle of each instance, where the fog is all around.
TEST_P(MirroredInstances, AreAlikeWithin) {
    const auto within = [&](double side) {
        const Camera camera = perspective({1.2 * side, 0.9, 0.1}, {1.5 * side, 0, 1}, 1);
        return image_mean(seen_by(camera, 0.0065));
    };
    EXPECT_TRUE(agree(within(1), within(-1), {.bias = 0.01}));
}

INSTANTIATE_TEST_SUITE_P(
    Files,
    MirroredInstances,
    testing::Values("fog", "glass", "lamp", "metal"),
    [](const testing::TestParamInfo<const char*>& file) { return std::string(file.param); });

}  // namespace
}  // namespace wavepath
