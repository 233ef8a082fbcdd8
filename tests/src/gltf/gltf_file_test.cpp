#include "gltf/gltf_file.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <tuple>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string file_error(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    return error_of([&] { load_gltf(folder.write(name, bytes)); });
}

GltfBuilder triangle() {
    GltfBuilder gltf;
    gltf.triangle();
    return gltf;
}

TEST(GltfFile, TellsBinaryFromTextByContent) {
    const GltfBuilder gltf = triangle();
    EXPECT_EQ(file_error("scene.glb", gltf.binary()), "");
    EXPECT_EQ(file_error("scene.gltf", gltf.binary()), "");
    EXPECT_EQ(file_error("scene.glb", gltf.text()), "");
    EXPECT_EQ(file_error("scene", gltf.text()), "");
    EXPECT_EQ(file_error("scene.gltf", "\xEF\xBB\xBF\n" + gltf.text()), "") << "byte order mark";
}

TEST(GltfFile, ReadsBuffersBesideIt) {
    const TemporaryFolder folder;
    GltfBuilder gltf = triangle();
    const std::string binary = gltf.binary();
    folder.write("my data.bin", binary.substr(binary.size() - 36));
    gltf.root["buffers"] = {{{"byteLength", 36}, {"uri", "my%20data.bin"}}};
    EXPECT_EQ(load_gltf(folder.write("scene.gltf", gltf.text())).triangle_count(), 1U);
}

TEST(GltfFile, DoesNotLookForBuffersInTheWorkingDirectory) {
    const TemporaryFolder folder;
    GltfBuilder gltf = triangle();
    gltf.root["buffers"] = {{{"byteLength", 36}, {"uri", "data.bin"}}};
    std::filesystem::create_directory(folder / "scene");
    const auto path = folder.write("scene/scene.gltf", gltf.text());
    folder.write("data.bin", std::string(36, '\0'));
    const auto working_directory = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const std::string error = error_of([&] { load_gltf("scene/scene.gltf"); });
    std::filesystem::current_path(working_directory);
    EXPECT_EQ(error, "scene.gltf: buffer 0: data.bin is not there; put it beside the scene");
}

TEST(GltfFile, SaysWhatIsNoFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(
        error_of([&] { load_gltf(folder / "absent.gltf"); }),
        (folder / "absent.gltf").string() + ": no such file; check the path");
    EXPECT_EQ(
        error_of([&] { load_gltf(folder.path()); }),
        folder.path().string() + ": is not a regular file; name a .gltf or .glb file");
}

TEST(GltfFile, SaysWhatIsNoGltf) {
    for (const char* bytes : {"", " \n", "hello", "[]", "\x89PNG"})
        EXPECT_EQ(
            file_error("a.gltf", bytes), "a.gltf: is not glTF; export the scene as .gltf or .glb");
    EXPECT_THAT(
        file_error("a.gltf", "{\"asset\":"), HasSubstr("a.gltf: not valid glTF: [json.exception"));
    EXPECT_THAT(file_error("a.gltf", "{\"a\":1}"), HasSubstr("a.gltf: asset is missing; repair"));
}

TEST(GltfFile, SaysWhereBinaryFilesAreCut) {
    const std::string whole = triangle().binary();
    for (std::size_t size = 4; size < whole.size(); ++size)
        EXPECT_THAT(file_error("a.glb", whole.substr(0, size)), HasSubstr("is cut short")) << size;
    std::string newer = whole;
    newer[4] = 3;
    EXPECT_EQ(file_error("a.glb", newer), "a.glb: is binary glTF version 3; export as glTF 2.0");
    std::string long_chunk = whole;
    long_chunk[15] = '\x7F';
    EXPECT_THAT(file_error("a.glb", long_chunk), HasSubstr("is cut short or gives a wrong length"));
}

TEST(GltfFile, SurvivesEveryCutAndManyFlippedBits) {
    const std::string text = triangle().text();
    for (std::size_t size = 0; size < text.size(); ++size)
        EXPECT_NE(file_error("a.gltf", text.substr(0, size)), "");
    for (const std::string& whole : {text, triangle().binary()})
        for (std::size_t i = 0; i < 8 * whole.size(); i += 3) {
            std::string flipped = whole;
            flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ 1 << i % 8);
            EXPECT_THAT(file_error("a.gltf", flipped), Not(HasSubstr("\n")));
        }
}

TEST(GltfFile, SurvivesDeepNesting) {
    GltfBuilder gltf = triangle();
    std::string text = gltf.text();
    const std::string brackets(100000, '[');
    text.insert(1, "\"extras\":" + brackets + std::string(brackets.size(), ']') + ",");
    EXPECT_EQ(
        file_error("a.gltf", text), "a.gltf: JSON is nested deeper than 256 levels; export again");
    gltf.root["extras"] = "\\\"" + brackets;
    EXPECT_EQ(load_error(gltf), "") << "brackets in a string do not count";
}

TEST(GltfFile, ChecksTheVersion) {
    const auto error = [](const Json& asset) {
        GltfBuilder gltf = triangle();
        gltf.root["asset"] = asset;
        return load_error(gltf);
    };
    EXPECT_EQ(error({{"version", "2.1"}}), "") << "a newer minor version stays readable";
    EXPECT_EQ(error({{"version", "2.1"}, {"minVersion", "2.0"}}), "");
    EXPECT_EQ(
        error({{"version", "2.1"}, {"minVersion", "2.1"}}),
        "scene.gltf: asset: minVersion \"2.1\" asks for more than glTF 2.0; export as glTF 2.0");
    for (const char* version : {"1.0", "3.0", "", "2", "2.", "2.0.1", "two", "99999999999.0"})
        EXPECT_THAT(
            error({{"version", version}}), HasSubstr("is not supported; export as glTF 2.0"));
}

TEST(GltfFile, NamesRequiredExtensionsBeforeAnythingElse) {
    GltfBuilder gltf = triangle();
    for (const char* supported :
         {"EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
          "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
          "KHR_materials_specular", "KHR_materials_variants", "KHR_mesh_quantization",
          "KHR_node_visibility"})
        gltf.root["extensionsRequired"].push_back(supported);
    EXPECT_EQ(load_error(gltf), "");
    gltf.root["extensionsRequired"].push_back("KHR_texture_basisu");
    gltf.root["meshes"][0]["primitives"][0]["indices"] = 77;  // what tinygltf itself would report
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: extensionsRequired: KHR_texture_basisu is not supported; export without it");
}

TEST(GltfFile, BoundsWhatItQuotes) {
    GltfBuilder gltf = triangle();
    gltf.root["buffers"] = {{{"byteLength", 36}, {"uri", std::string(5000, '!')}}};
    EXPECT_THAT(load_error(gltf), AllOf(HasSubstr("..."), testing::SizeIs(testing::Lt(300U))));
}

}  // namespace
}  // namespace wavepath
