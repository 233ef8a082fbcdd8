#include "scene/gltf_loader.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

namespace wavepath {
namespace {

namespace fs = std::filesystem;
using Json = GltfBuilder::Json;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(GltfLoader, SaysOnceWhatItIgnores) {
    GltfBuilder gltf;
    gltf.triangle();
    gltf.root["extensionsUsed"] = {
        "KHR_materials_sheen", "KHR_materials_ior", "EXT_mesh_gpu_instancing",
        "KHR_materials_sheen"};
    gltf.root["skins"] = {{{"joints", {0}}}};
    gltf.root["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    gltf.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
    EXPECT_THAT(
        load(gltf).ignored,
        ElementsAre(
            "skins (1): rendered in the rest pose", "animations (1): rendered at rest",
            "morph targets (2): rendered in the base shape",
            "EXT_mesh_gpu_instancing: not supported, rendered without it",
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

// The folder of test assets, or an empty path.
fs::path asset_folder() {
    const char* named = std::getenv("WAVEPATH_ASSETS");
    const fs::path folder =
        named ? fs::path(named) : fs::path(WAVEPATH_SOURCE_DIR) / ".." / "shared" / "assets";
    return fs::is_directory(folder) ? folder : fs::path();
}

std::vector<fs::path> gltf_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

// Triangle counts by file from the table "| models/a/b.glb | ... | ... | 12 (6 unique) | ..." of
// INDEX.md.
std::map<std::string, std::size_t> listed_triangle_counts(const fs::path& index) {
    std::map<std::string, std::size_t> counts;
    std::ifstream stream(index);
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
        if (cells.size() < 5 || !cells[1].starts_with(" models/")) continue;
        const std::string file = cells[1].substr(1, cells[1].size() - 2);
        std::size_t count = 0;
        std::from_chars(cells[4].data() + 1, cells[4].data() + cells[4].size(), count);
        counts[file] = count;
    }
    return counts;
}

TEST(GltfLoader, LoadsTheSampleModels) {
    const fs::path assets = asset_folder();
    if (assets.empty()) GTEST_SKIP() << "no sample models: WAVEPATH_ASSETS names no folder";
    const std::map<std::string, std::string> failures{
        {"models/Box-Draco/Box.gltf", "KHR_draco_mesh_compression is not supported"},
        {"models/IridescenceSuzanne/IridescenceSuzanne.glb",
         "KHR_materials_iridescence is not supported"},
        {"models/meshopt-no-fallback/meshopt-no-fallback.gltf",
         "EXT_meshopt_compression is not supported"},
        {"models/NodeVisibility/khr_node_visibility_valid.gltf", "holds no triangles"}};
    auto counts = listed_triangle_counts(assets / "INDEX.md");
    counts["models/MultipleScenes/MultipleScenes.gltf"] =
        2;  // of its second scene, the default one
    counts["models/SimpleInstancing/SimpleInstancing.glb"] =
        12;  // EXT_mesh_gpu_instancing is ignored
    for (const fs::path& path : gltf_files(assets / "models")) {
        const std::string file = fs::relative(path, assets).generic_string();
        SCOPED_TRACE(file);
        std::size_t count = 0;
        const std::string error = error_of([&] { count = load_gltf(path).triangle_count(); });
        if (const auto failure = failures.find(file); failure != failures.end()) {
            EXPECT_THAT(error, HasSubstr(failure->second));
        } else {
            EXPECT_EQ(error, "");
            EXPECT_EQ(count, counts[file]);
        }
    }
}

// Where these load they are sound: the first four ask for nothing beyond glTF 2.0.
TEST(GltfLoader, SurvivesInvalidFiles) {
    const fs::path assets = asset_folder();
    if (assets.empty()) GTEST_SKIP() << "no invalid files: WAVEPATH_ASSETS names no folder";
    std::vector<std::string> loaded;
    for (const fs::path& path : gltf_files(assets / "invalid")) {
        SCOPED_TRACE(path);
        const std::string error = error_of([&] {
            EXPECT_EQ(load_gltf(path).triangle_count(), 2U);
            loaded.push_back(path.stem());
        });
        if (error.empty()) continue;
        EXPECT_THAT(error, HasSubstr(path.filename().string() + ": "));
        EXPECT_THAT(error, AllOf(HasSubstr("; "), Not(HasSubstr("\n"))));
    }
    EXPECT_THAT(
        loaded,
        ElementsAre(
            "Compatibility_00", "Compatibility_01", "Compatibility_02", "Compatibility_03"));
}

}  // namespace
}  // namespace wavepath
