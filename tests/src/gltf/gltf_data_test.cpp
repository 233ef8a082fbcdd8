// Tests src/gltf/gltf_data.cpp, gltf_container.cpp and gltf_placeholders.cpp: valid files that
// tinygltf by itself refuses.
#include "gltf/gltf_data.h"

#include "support/case_files.h"
#include "support/gltf_builder.h"

#include <gmock/gmock.h>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::HasSubstr;

GltfBuilder triangle() {
    GltfBuilder gltf;
    gltf.triangle();
    return gltf;
}

// The 36 bytes of its buffer.
std::string triangle_bytes() {
    const std::string binary = triangle().binary();
    return binary.substr(binary.size() - 36);
}

std::string triangle_base64() {
    const std::string uri = Json::parse(triangle().text())["buffers"][0]["uri"];
    return uri.substr(uri.find(',') + 1);
}

std::string error_with_buffer(const Json& buffer) {
    GltfBuilder gltf = triangle();
    gltf.root["buffers"] = {buffer};
    return load_error(gltf);
}

std::string word(std::uint32_t value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

struct Chunk {
    std::string type, data;
};

std::string binary_file(const std::vector<Chunk>& chunks) {
    std::string body;
    for (const auto& [type, data] : chunks)
        body += word(static_cast<std::uint32_t>(data.size())) + type + data;
    return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + body.size())) + body;
}

std::string error_of_chunks(const std::vector<Chunk>& chunks) {
    const TemporaryFolder folder;
    return error_of([&] { load_gltf(folder.write("a.glb", binary_file(chunks))); });
}

// The JSON of a triangle, padded, with these buffers.
std::string json_with(const Json& buffers) {
    GltfBuilder gltf = triangle();
    gltf.root["buffers"] = buffers;
    std::string json = gltf.text();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return json;
}

const std::string bin("BIN\0", 4);

TEST(GltfData, TakesDataUrisOfAnyType) {
    for (const char* type :
         {"", "application/octet-stream", "application/gltf-buffer", "model/vnd.something",
          "application/octet-stream;charset=US-ASCII", "text/plain"})
        EXPECT_EQ(
            error_with_buffer(
                {{"byteLength", 36},
                 {"uri", std::string("data:") + type + ";base64," + triangle_base64()}}),
            "")
            << type;
    std::string escaped = triangle_base64();
    for (std::size_t at = 0; (at = escaped.find('A', at)) != escaped.npos && at < 20; at += 3)
        escaped.replace(at, 1, "%41");
    EXPECT_EQ(error_with_buffer({{"byteLength", 36}, {"uri", "data:;base64," + escaped}}), "");
}

TEST(GltfData, SaysWhatIsNoBase64) {
    for (const std::string& uri :
         {"data:application/octet-stream," + triangle_base64(), std::string("data:"),
          "data:;base64," + triangle_base64().substr(0, 9) + "!" + triangle_base64().substr(10)})
        EXPECT_EQ(
            error_with_buffer({{"byteLength", 36}, {"uri", uri}}),
            "scene.gltf: buffer 0: its data URI is not base64; export again");
}

TEST(GltfData, CutsWhatIsLongerThanItsBuffer) {
    const std::string prefix = "data:application/octet-stream;base64,";
    EXPECT_EQ(
        error_with_buffer({{"byteLength", 36}, {"uri", prefix + triangle_base64() + "AAAA"}}), "");
    const TemporaryFolder folder;
    for (const std::size_t more : {1, 3, 36, 4096}) {
        folder.write("a.bin", triangle_bytes() + std::string(more, 'x'));
        GltfBuilder gltf = triangle();
        gltf.root["buffers"] = {{{"byteLength", 36}, {"uri", "a.bin"}}};
        const Scene scene = load_gltf(folder.write("scene.gltf", gltf.text()));
        EXPECT_EQ(scene.primitives.at(0).positions, load(triangle()).primitives.at(0).positions);
        EXPECT_THAT(scene.files, testing::ElementsAre(folder / "a.bin"));
        // what lies beyond is none of the buffer
        gltf.root["bufferViews"][0]["byteOffset"] = 1;
        EXPECT_THAT(
            error_of([&] { load_gltf(folder.write("scene.gltf", gltf.text())); }),
            HasSubstr("ends after its buffer of 36 bytes"));
    }
    EXPECT_EQ(
        error_with_buffer({{"byteLength", 40}, {"uri", prefix + triangle_base64()}}),
        "scene.gltf: buffer 0: has 36 bytes, but byteLength 40; the file is cut short or wrong, "
        "export again");
}

TEST(GltfData, FindsFilesByTheirNames) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "d");
    for (const auto& [file, uri] : std::vector<std::pair<std::string, std::string>>{
             {"a+b.bin", "a+b.bin"},
             {"a b.bin", "a%20b.bin"},
             {"100%.bin", "100%.bin"},
             {"d/\xC3\xBC.bin", "d/%c3%BC.bin"}}) {
        folder.write(file, triangle_bytes());
        GltfBuilder gltf = triangle();
        gltf.root["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        EXPECT_EQ(load_gltf(folder.write("scene.gltf", gltf.text())).triangle_count(), 1U) << uri;
    }
    for (const char* uri : {"/etc/passwd", "d", "https://example.org/a.bin", ""})
        EXPECT_THAT(
            error_with_buffer({{"byteLength", 36}, {"uri", uri}}),
            HasSubstr("is not there; put it beside the scene"));
}

TEST(GltfData, NeedsNoDataThatNothingReads) {
    const Json whole = Json::parse(triangle().text())["buffers"][0];
    for (const Json& other :
         {Json{{"byteLength", 64}}, Json{{"byteLength", 64}, {"uri", "absent.bin"}},
          Json{{"byteLength", 64}, {"uri", "data:;base64,AAAA"}}}) {
        GltfBuilder gltf = triangle();
        gltf.root["buffers"] = {whole, other};
        gltf.root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 64}});
        EXPECT_EQ(load_error(gltf), "") << other;
    }
    GltfBuilder gltf = triangle();
    gltf.root["buffers"] = {{{"byteLength", 36}, {"name", "corners"}}};
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: buffer 0 \"corners\": has no uri, and so no data; export again");
    gltf = triangle();
    gltf.root["images"] = {{{"uri", "a.png"}, {"bufferView", 0}}};
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: image 0: has both a bufferView and a uri; remove one of them");
}

TEST(GltfContainer, PassesOverOtherChunks) {
    const std::string json = json_with({{{"byteLength", 36}}});
    const Chunk data{bin, triangle_bytes()};
    EXPECT_EQ(error_of_chunks({{"JSON", json}, data}), "");
    EXPECT_EQ(error_of_chunks({{"JSON", json}, data, {"XTRA", "1234"}}), "");
    EXPECT_EQ(error_of_chunks({{"JSON", json}, {"XTRA", "12345678"}, data, {"MORE", ""}}), "");
    EXPECT_EQ(error_of_chunks({{"JSON", json}, data, {bin, "1234"}}), "") << "the first counts";
}

TEST(GltfContainer, NeedsNoDataInABinaryFile) {
    const std::string json = json_with(Json::parse(triangle().text())["buffers"]);
    EXPECT_EQ(error_of_chunks({{"JSON", json}}), "");
    EXPECT_EQ(error_of_chunks({{"JSON", json}, {bin, ""}}), "");
    EXPECT_EQ(
        error_of_chunks({{"JSON", json_with({{{"byteLength", 36}}})}, {bin, ""}}),
        "a.glb: buffer 0: has 0 bytes, but byteLength 36; the file is cut short or wrong, export "
        "again");
}

TEST(GltfContainer, SaysWhatIsWrongWithChunks) {
    const std::string json = json_with({{{"byteLength", 36}}});
    EXPECT_THAT(
        error_of_chunks({{bin, triangle_bytes()}, {"JSON", json}}),
        HasSubstr("its first chunk has to hold JSON"));
    EXPECT_THAT(
        error_of_chunks({{"JSON", json + " "}, {bin, triangle_bytes()}}),
        HasSubstr("is not padded to a multiple of 4"));
}

TEST(GltfPlaceholders, LetIndicesHaveNoView) {
    GltfBuilder gltf;
    const int targets = gltf.view(std::vector<std::uint8_t>{1, 2});
    const int values = gltf.view(std::vector<std::uint16_t>{1, 2});
    const int indices = gltf.add(
        "accessors", {{"componentType", 5123},
                      {"count", 3},
                      {"type", "SCALAR"},
                      {"sparse",
                       {{"count", 2},
                        {"indices", {{"bufferView", targets}, {"componentType", 5121}}},
                        {"values", {{"bufferView", values}}}}}});
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}}}, {"indices", indices}});
    EXPECT_THAT(load(gltf).primitives.at(0).indices, testing::ElementsAre(0, 1, 2));
}

TEST(GltfPlaceholders, LetAnimationsMoveAnything) {
    GltfBuilder gltf = triangle();
    gltf.root["extensionsUsed"] = {"KHR_animation_pointer"};
    gltf.root["animations"] = {
        {{"samplers", {{{"input", 0}, {"output", 0}}}},
         {"channels",
          {{{"sampler", 0},
            {"target",
             {{"path", "pointer"},
              {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/scale"}}}}}}}}}}}};
    EXPECT_THAT(load(gltf).ignored, testing::ElementsAre("animations (1): rendered at rest"));
}

TEST(GltfFile, TakesExtensionsThatShowInNoPicture) {
    GltfBuilder gltf = triangle();
    for (const char* extension :
         {"EXT_mesh_features", "EXT_structural_metadata", "KHR_animation_pointer", "KHR_xmp",
          "KHR_xmp_json_ld"}) {
        gltf.root["extensionsUsed"].push_back(extension);
        gltf.root["extensionsRequired"].push_back(extension);
    }
    EXPECT_TRUE(load(gltf).ignored.empty());
    gltf.root["extensionsRequired"].push_back("EXT_lights_image_based");
    EXPECT_THAT(load_error(gltf), HasSubstr("EXT_lights_image_based is not supported"));
}

TEST(GltfData, ReadsTheFilesOfOthers) {
    for (const char* name : {"bin-longer", "files", "matrix-rounding"}) {
        const auto folder = case_folder(name);
        if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".gltf") continue;
            EXPECT_EQ(error_of([&] { load_gltf(entry.path()); }), "") << entry.path();
        }
    }
}

}  // namespace
}  // namespace wavepath
