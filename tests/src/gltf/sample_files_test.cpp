// Files as people have them, sound and broken.
#include "support/sample_files.h"
#include "gltf/gltf_loader.h"
#include "prepare/normalise.h"
#include "scene/camera.h"
#include "support/rendering.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

namespace wavepath {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

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

TEST(SampleFiles, ModelsLoadOrSayWhyNot) {
    const fs::path assets = asset_folder();
    if (assets.empty()) GTEST_SKIP() << "no sample models: WAVEPATH_ASSETS names no folder";
    const std::map<std::string, std::string> failures{
        {"models/IridescenceSuzanne/IridescenceSuzanne.glb",
         "KHR_materials_iridescence is not supported"},
        {"models/NodeVisibility/khr_node_visibility_valid.gltf", "holds no triangles"}};
    auto counts = listed_triangle_counts(assets / "INDEX.md");
    ASSERT_EQ(counts.size(), 44U);
    counts["models/MultipleScenes/MultipleScenes.gltf"] = 2;  // of the default scene, its second
    for (const auto& [file, count] : counts) {
        SCOPED_TRACE(file);
        const fs::path path = assets / file;
        std::size_t loaded = 0;
        const std::string error = error_of([&] { loaded = load_gltf(path).triangle_count(); });
        if (const auto failure = failures.find(file); failure != failures.end()) {
            EXPECT_THAT(error, HasSubstr(failure->second));
        } else {
            EXPECT_EQ(error, "");
            EXPECT_EQ(loaded, count);
        }
    }
}

// No sample of any model is a NaN, and a second render gives the same bytes.
TEST(SampleFiles, ModelsRenderTheSameTwiceWithoutNaN) {
    const fs::path assets = asset_folder();
    if (assets.empty()) GTEST_SKIP() << "no sample models: WAVEPATH_ASSETS names no folder";
    std::size_t rendered = 0;
    for (const auto& [file, count] : listed_triangle_counts(assets / "INDEX.md")) {
        SCOPED_TRACE(file);
        const fs::path path = assets / file;
        Scene scene;
        if (!error_of([&] { scene = load_gltf(path); }).empty()) continue;
        scene.environment = constant_environment(1);
        const RenderSettings settings = square_settings("mis", choose_camera(scene, ""), 24, 4);
        const RenderResult first = render(test_device(), scene, settings);
        EXPECT_EQ(first.film.nonfinite.samples, 0U);
        const RenderResult second = render(test_device(), scene, settings);
        EXPECT_EQ(first.film.image.channels, second.film.image.channels);
        ++rendered;
    }
    EXPECT_EQ(rendered, 42U);
}

// Triangles turned round until they begin with their least index: the codec for triangles keeps
// their order and their winding, not their first corner.
std::vector<std::uint32_t> least_corner_first(std::vector<std::uint32_t> indices) {
    for (auto first = indices.begin(); first != indices.end(); first += 3)
        std::rotate(first, std::min_element(first, first + 3), first + 3);
    return indices;
}

// The compressed files hold the same mesh as their fallback: 14 bits a coordinate, no bit lost.
TEST(SampleFiles, CompressedModelsEqualTheirFallback) {
    const fs::path assets = asset_folder();
    if (assets.empty()) GTEST_SKIP() << "no sample models: WAVEPATH_ASSETS names no folder";
    const TemporaryFolder folder;
    for (const auto& entry : fs::directory_iterator(assets / "models/meshopt-fallback"))
        fs::copy_file(entry.path(), folder / entry.path().filename().string());
    const fs::path file = folder / "meshopt-fallback.gltf";
    const Scene decoded = load_gltf(file);
    std::ifstream stream(file);
    auto root = nlohmann::json::parse(stream);
    for (const char* compressed : {"buffers", "bufferViews"})
        for (auto& element : root[compressed]) element.erase("extensions");
    const Scene fallback = load_gltf(folder.write("plain.gltf", root.dump()));
    ASSERT_EQ(decoded.primitives.size(), fallback.primitives.size());
    for (std::size_t i = 0; i < decoded.primitives.size(); ++i) {
        EXPECT_EQ(decoded.primitives[i].positions, fallback.primitives[i].positions);
        EXPECT_EQ(
            least_corner_first(decoded.primitives[i].indices),
            least_corner_first(fallback.primitives[i].indices));
    }
}

// Quantized to 14 bits over the duck's 1.7 m.
TEST(SampleFiles, TheQuantizedDuckIsTheDuck) {
    const fs::path assets = asset_folder();
    if (assets.empty()) GTEST_SKIP() << "no sample models: WAVEPATH_ASSETS names no folder";
    const Extent plain = extent_of(load_gltf(assets / "models/Duck/Duck.glb"));
    const Extent quantized = extent_of(load_gltf(assets / "models/Duck-Quantized/Duck.gltf"));
    EXPECT_NEAR(quantized.metres, plain.metres, 2e-4 * plain.metres);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(quantized.centre[k], plain.centre[k], 2e-4 * plain.metres);
}

// What each malformed file is refused with; those not listed are sound for a renderer of glTF 2.0.
const std::map<std::string, std::string> refusals{
    {"validator/accessor__alignment.gltf", "default scene: holds no triangles"},
    {"validator/accessor__byteoffset_no_bufferview.gltf", "default scene: holds no triangles"},
    {"validator/accessor__invalid_sparse_count_and_stride.gltf",
     "default scene: holds no triangles"},
    {"validator/accessor__unknown_type.gltf",
     "Unsupported `type` for accessor object. Got \"NotaVEC3\""},
    {"validator/accessor__unresolved_bufferviews.gltf", "default scene: holds no triangles"},
    {"validator/accessor_data__invalid_elements_float.gltf", "default scene: holds no triangles"},
    {"validator/asset__1_0_version.gltf", "asset: version \"1.0\" is not supported"},
    {"validator/asset__invalid_version.gltf", "asset: version \"1.0.1-dev\" is not supported"},
    {"validator/buffer__invalid_uri_data.gltf", "default scene: holds no triangles"},
    {"validator/buffer__not_found.gltf", "default scene: holds no triangles"},
    {"validator/buffer__no_bin_chunk.glb", "default scene: holds no triangles"},
    {"validator/buffer__wrong_bytelength.glb", "default scene: holds no triangles"},
    {"validator/buffer_view__invalid_length.gltf", "default scene: holds no triangles"},
    {"validator/buffer_view__unresolved_buffer.gltf", "default scene: holds no triangles"},
    {"validator/camera__infinite_znear.gltf", "number overflow parsing '1e309'"},
    {"validator/camera__perspective_yfov.gltf", "default scene: holds no triangles"},
    {"validator/glb__empty_file.glb", "is not glTF"},
    {"validator/glb__chunk_too_big.glb", "is cut short or gives a wrong length"},
    {"validator/glb__invalid_magic.glb", "is not glTF"},
    {"validator/glb__invalid_version.glb", "is binary glTF version 0"},
    {"validator/glb__length_mismatch.glb", "is cut short or gives a wrong length"},
    {"validator/glb__truncated_chunk_data.glb", "is cut short or gives a wrong length"},
    {"validator/glb__invalid_json_chunk.glb", "parse error at line 1, column 2"},
    {"validator/image__invalid_data_uri.gltf", "default scene: holds no triangles"},
    {"validator/image__not_found.gltf", "default scene: holds no triangles"},
    {"validator/image__png_eos.gltf", "default scene: holds no triangles"},
    {"validator/json__empty_file.gltf", "is not glTF"},
    {"validator/json__invalid_syntax.gltf", "parse error at line 1, column 2"},
    {"validator/material__unresolved_basecolor.gltf",
     "material 0, baseColorTexture: refers to texture 0, but the file has 0 of them"},
    {"validator/mesh__unresolved_positions.gltf", "default scene: holds no triangles"},
    {"validator/mesh__unresolved_indices.gltf", "default scene: holds no triangles"},
    {"validator/mesh__accessor_unequal_count.gltf", "default scene: holds no triangles"},
    {"validator/mesh_data__index_buffer_oob.gltf", "default scene: holds no triangles"},
    {"validator/node__node_loop.gltf",
     "nodes: some are their own ancestors, nodes must form a tree"},
    {"validator/node__unresolved_mesh.gltf",
     "node 0: refers to mesh 0, but the file has 0 of them"},
    {"validator/node__infinite_transform.gltf", "number overflow parsing '1e309'"},
    {"validator/scene__unresolved_node.gltf",
     "scene 0: refers to node 0, but the file has 0 of them"},
    {"validator/texture__unresolved_source.gltf", "default scene: holds no triangles"},
    {"validator/ext_volume__out_of_range.gltf", "default scene: holds no triangles"},
    {"validator/ext_volume__unknown_transmission.gltf", "default scene: holds no triangles"},
    {"validator/ext_volume__valid.gltf", "default scene: holds no triangles"},
    {"validator/ext_lights__spot_invalid_angles.gltf", "default scene: holds no triangles"},
    {"validator/ext_lights__unknown_type.gltf", "default scene: holds no triangles"},
    {"validator/ext_lights__empty_light_object.gltf", "light 0: type is missing"},
    {"tinygltf/invalid-buffer-index.gltf", "default scene: holds no triangles"},
    {"tinygltf/invalid-buffer-view-index.gltf", "default scene: holds no triangles"},
    {"tinygltf/invalid-primitive-indices.gltf", "default scene: holds no triangles"},
    {"tinygltf/integer-out-of-bounds.gltf", "bufferView 0: byteLength is 1e+300, not an integer"},
    {"gltf-sdk/CubeInvalidAccessorByteLength.glb", "is binary glTF version 1"},
    {"gltf-sdk/CubeInvalidBufferViewLength.glb", "is binary glTF version 1"},
    {"gltf-sdk/WrongReportedLength.glb", "is cut short or gives a wrong length"},
    {"magnum/scene-invalid-cycle.gltf",
     "nodes: some are their own ancestors, nodes must form a tree"},
    {"magnum/scene-invalid-child-oob.gltf", "node 4: refers to node 7, but the file has 7 of them"},
    {"magnum/buffer-invalid-short-size.glb", "default scene: holds no triangles"},
    {"magnum/mesh-invalid.gltf",
     "mesh 41 \"invalid primitive property\": primitives[0].mode is -1, not an integer"},
    {"assimp/wrongTypes__badNumber.gltf", "material 0 \"Texture\": normalTexture.index is missing"},
    {"assimp/wrongTypes__badArray.gltf", "mesh 0 \"Mesh\": primitives is an object, not an array"},
    {"assimp/MissingBin__BoxTextured.gltf", "buffer 0: BoxTextured0.bin is not there"},
    {"asset-generator-compat/Compatibility_04.gltf",
     "asset: minVersion \"2.1\" asks for more than glTF 2.0"},
    {"asset-generator-compat/Compatibility_05.gltf",
     "extensionsRequired: FAKE_materials_quantumRendering is not supported"},
};

TEST(SampleFiles, MalformedFilesAreRefusedInOneLineOrRendered) {
    const fs::path assets = asset_folder();
    if (assets.empty()) GTEST_SKIP() << "no malformed files: WAVEPATH_ASSETS names no folder";
    std::ifstream stream(assets / "invalid" / "MANIFEST.json");
    const auto manifest = nlohmann::json::parse(stream);
    ASSERT_EQ(manifest.size(), 64U);
    for (const auto& entry : manifest) {
        const fs::path path = assets / "invalid" / entry["file"].get<std::string>();
        SCOPED_TRACE(path);
        const auto refusal = refusals.find(entry["file"]);
        if (refusal == refusals.end()) {
            Scene scene = load_gltf(path);
            EXPECT_EQ(scene.triangle_count(), 2U);
            scene.environment = constant_environment(1);
            const RenderResult result =
                render_scene(scene, square_settings("mis", choose_camera(scene, ""), 16, 1));
            EXPECT_EQ(result.film.nonfinite.samples, 0U);
        } else {
            EXPECT_THAT(
                error_of([&] { load_gltf(path); }),
                AllOf(
                    StartsWith(path.filename().string() + ": "), HasSubstr(refusal->second),
                    HasSubstr("; "), Not(HasSubstr("\n"))));
        }
    }
}

}  // namespace
}  // namespace wavepath
