#include "gltf/gltf_loader.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::ElementsAre;

TEST(GltfLoader, SaysOnceWhatItIgnores) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["extensionsUsed"] = {
        "KHR_materials_sheen", "KHR_materials_ior", "KHR_materials_variants", "EXT_unheard_of",
        "KHR_materials_sheen"};
    gltf.root["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    EXPECT_THAT(
        load(gltf).ignored, ElementsAre(
                                "animations (1): rendered at rest",
                                "EXT_unheard_of: not supported, rendered without it",
                                "KHR_materials_sheen: not supported, rendered without it"));
}

TEST(GltfLoader, DoesNotCareWhetherImagesCanBeReadThatNothingUses) {
    const TemporaryFolder folder;
    folder.write("broken.png", "not a png");
    folder.write("empty.png", "");
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["images"] = {
        {{"uri", "absent.png"}},
        {{"uri", "broken.png"}},
        {{"uri", "empty.png"}},
        {{"uri", "data:image/png;base64,AAAA"}},
        {{"uri", "data:image/webp;base64,AAAA"}},
        {{"bufferView", 0}, {"mimeType", "image/ktx2"}}};
    EXPECT_EQ(load_gltf(folder.write("scene.gltf", gltf.text())).triangle_count(), 1U);
}

TEST(GltfLoader, NeedsTriangles) {
    const std::string expected =
        "scene.gltf: default scene: holds no triangles; add a mesh to it or choose another file";
    GltfBuilder gltf;
    EXPECT_EQ(load_error(gltf), expected);
    gltf.triangle();
    gltf.root["nodes"][0]["scale"] = {0, 0, 0};
    EXPECT_EQ(load_error(gltf), expected);
}

}  // namespace
}  // namespace wavepath
