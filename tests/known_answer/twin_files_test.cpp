// Files that say the same in two ways have the same picture, to the bit.
#include "gltf/gltf_loader.h"
#include "support/case_files.h"
#include "support/rendering.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

struct Twins {
    const char* folder;
    const char* first;
    std::vector<const char*> others;
};

class TwinFiles : public testing::TestWithParam<Twins> {};

// A quad of 2 m in a white furnace, in the middle of the picture.
RenderResult picture_of(Scene scene) {
    scene.environment = constant_environment(1);
    return render_scene(
        scene, square_settings("mis", perspective({0, 0, 3}, {0, 0, 0}, 0.5236), 16, 4));
}

// All of these were refused once: buffers longer than their byteLength, matrices whose last row
// had been rounded, and what `files` holds.
TEST_P(TwinFiles, HaveTheSamePicture) {
    const Twins& twins = GetParam();
    const auto folder = case_folder(twins.folder);
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    const auto load = [&](const char* name) {
        return load_gltf(folder / (std::string(name) + ".gltf"));
    };
    const Scene first = load(twins.first);
    const std::vector<float> corners{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    EXPECT_EQ(first.primitives.at(0).positions, corners);
    EXPECT_EQ(first.instances.at(0).to_world, identity_matrix);
    const RenderResult truth = picture_of(first);
    const auto& channels = truth.film.image.channels;
    EXPECT_TRUE(std::ranges::all_of(channels.at("R"), [](float x) { return x > 0; }));
    for (const char* name : twins.others) {
        const Scene other = load(name);
        EXPECT_EQ(other.instances.at(0).to_world, identity_matrix) << name;
        EXPECT_EQ(picture_of(other).film.image.channels, channels) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Folders,
    TwinFiles,
    testing::Values(
        Twins{"bin-longer", "exact", {"embedded_exact", "plus2", "plus36", "embedded_plus2"}},
        Twins{"matrix-rounding", "exact", {"w_above", "w_below", "tiny_3", "minus_zero"}},
        Twins{
            "files",
            "datauri_nomime",
            {"animation_pointer", "buffer_nouri", "req_KHR_xmp_json_ld"}}),
    [](const testing::TestParamInfo<Twins>& twins) {
        std::string name = twins.param.folder;
        std::ranges::replace(name, '-', '_');
        return name;
    });

}  // namespace
}  // namespace wavepath
