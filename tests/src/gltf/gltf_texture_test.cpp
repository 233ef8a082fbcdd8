#include "gltf/gltf_texture.h"

#include "support/gltf_builder.h"
#include "support/images.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

const std::vector<uint8_t> two_texels{255, 0, 0, 255, 51, 102, 204, 128};

// A triangle whose material has this base colour textureInfo, with TEXCOORD_0 and TEXCOORD_1.
GltfBuilder textured(const Json& info, const Json& image, const Json& texture = {{"source", 0}}) {
    GltfBuilder gltf;
    gltf.add("images", image);
    gltf.add("textures", texture);
    gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", info}}}});
    const int first = gltf.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
    const int second = gltf.accessor<std::uint8_t>(
        "VEC2", {0, 255, 0, 0, 51, 0, 0, 0, 255, 255, 0, 0}, {{"normalized", true}, {"count", 3}});
    gltf.root["bufferViews"][static_cast<std::size_t>(second)]["byteStride"] = 4;
    gltf.object(
        {{"attributes",
          {{"POSITION", gltf.triangle_positions()}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}}},
         {"material", 0}});
    return gltf;
}

Json data_uri(const std::string& bytes, const std::string& type = "image/png") {
    return {{"uri", "data:" + type + ";base64," + base64_of(bytes)}};
}

const Json plain_info{{"index", 0}};

std::vector<uint32_t> words_of(const Json& image) {
    return load(textured(plain_info, image)).images.at(0).words;
}

TEST(GltfTexture, ReadsPngs) {
    const Scene scene = load(textured(plain_info, data_uri(png_file(2, 1, two_texels))));
    ASSERT_THAT(scene.images, SizeIs(1));
    EXPECT_EQ(scene.images[0].width, 2U);
    EXPECT_EQ(scene.images[0].height, 1U);
    EXPECT_FALSE(scene.images[0].wide);
    EXPECT_THAT(scene.images[0].words, ElementsAre(0xFF0000FFU, 0x80CC6633U));
    const Texture& texture = scene.materials.at(0).texture(TEXTURE_BASE_COLOR);
    EXPECT_EQ(texture.image, 0U);
    EXPECT_TRUE(texture.srgb);
    EXPECT_FALSE(texture.nearest);
    EXPECT_EQ(texture.wrap_s, Wrap::repeat);
    EXPECT_THAT(scene.primitives.at(0).uvs[0], ElementsAre(0, 0, 1, 0, 0, 1));
    EXPECT_TRUE(scene.primitives[0].uvs[1].empty()) << "nothing uses the second set";
}

TEST(GltfTexture, KeepsSixteenBitsAndIgnoresGamma) {
    const Scene scene = load(textured(plain_info, data_uri(wide_png_file())));
    EXPECT_TRUE(scene.images.at(0).wide);
    EXPECT_THAT(
        scene.images[0].words,
        ElementsAre(32768U << 16U, 65535U | 12345U << 16U, 1U | 2U << 16U, 3U | 4U << 16U));
    EXPECT_THAT(words_of(data_uri(gamma_png_file())), ElementsAre(0xFF808080U));
}

TEST(GltfTexture, ReadsJpegs) {
    const std::vector<uint8_t> grey(std::size_t{4} * 64, 200);
    for (const uint32_t word : words_of(data_uri(jpeg_file(8, 8, grey), "image/jpeg"))) {
        for (const uint32_t shift : {0U, 8U, 16U}) EXPECT_NEAR(word >> shift & 255U, 200, 2);
        EXPECT_EQ(word >> 24U, 255U);
    }
}

TEST(GltfTexture, ReadsWebpsWhetherRequiredOrNot) {
    GltfBuilder gltf = textured(
        plain_info, {{"uri", "absent.png"}},
        {{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}});
    gltf.add("images", data_uri(webp_file(), "image/webp"));
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        gltf.root[list] = {"EXT_texture_webp"};
        const Scene scene = load(gltf);
        ASSERT_THAT(scene.images, SizeIs(1));
        // green, by a codec that loses a little
        for (const uint32_t word : scene.images[0].words) {
            EXPECT_LE(word & 255U, 2U);
            EXPECT_GE(word >> 8U & 255U, 253U);
            EXPECT_LE(word >> 16U & 255U, 2U);
            EXPECT_EQ(word >> 24U, 255U);
        }
    }
}

TEST(GltfTexture, ReadsBufferViewsAndFilesWithStrangeNames) {
    const std::string png = png_file(2, 1, two_texels);
    GltfBuilder embedded = textured(plain_info, {});
    const int view = embedded.view(std::vector<char>(png.begin(), png.end()));
    embedded.root["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
    const TemporaryFolder folder;
    EXPECT_THAT(load_gltf(folder.write("scene.glb", embedded.binary())).images, SizeIs(1));

    folder.write("two words ❤.png", png);
    for (const char* uri : {"two%20words%20%E2%9D%A4.png", "two words ❤.png"})
        EXPECT_THAT(
            load_gltf(folder.write("scene.gltf", textured(plain_info, {{"uri", uri}}).text()))
                .images,
            SizeIs(1));
}

TEST(GltfTexture, DecodesEachImageOnceAndOnlyWhatIsWorn) {
    GltfBuilder gltf = textured(plain_info, data_uri(png_file(2, 1, two_texels)));
    gltf.add("images", {{"uri", "absent.png"}});
    gltf.add("textures", {{"source", 1}});
    gltf.root["materials"][0]["emissiveTexture"] = {{"index", 0}};
    gltf.add("materials", {{"emissiveTexture", {{"index", 1}}}});
    const Scene scene = load(gltf);
    EXPECT_THAT(scene.images, SizeIs(1));
    EXPECT_TRUE(scene.materials[0].has(TEXTURE_EMISSION));
    EXPECT_FALSE(scene.materials[1].has(TEXTURE_EMISSION));
}

TEST(GltfTexture, ReadsSamplers) {
    GltfBuilder gltf =
        textured(plain_info, data_uri(png_file(2, 1, two_texels)), {{"source", 0}, {"sampler", 0}});
    gltf.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    const Texture texture = load(gltf).materials.at(0).texture(TEXTURE_BASE_COLOR);
    EXPECT_EQ(texture.wrap_s, Wrap::clamp);
    EXPECT_EQ(texture.wrap_t, Wrap::mirror);
    EXPECT_TRUE(texture.nearest);
}

TEST(GltfTexture, RefusesTransformsBeyondFloats) {
    for (const char* key : {"scale", "offset"})
        EXPECT_THAT(
            load_error(textured(
                {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{key, {1e39, 1}}}}}}},
                data_uri(png_file(2, 1, two_texels)))),
            HasSubstr("not a pair of numbers"));
}

// A quarter turn counter-clockwise in a plane whose v points down takes (1, 0) to (0, -1).
TEST(GltfTexture, TransformsCoordinates) {
    const Json transform{
        {"offset", {0.5, 0.25}},
        {"rotation", std::numbers::pi / 2},
        {"scale", {2, 4}},
        {"texCoord", 1}};
    const Scene scene = load(textured(
        {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}},
        data_uri(png_file(2, 1, two_texels))));
    const auto& m = scene.materials.at(0).texture(TEXTURE_BASE_COLOR).transform;
    constexpr std::array<float, 6> expected{0, 4, 0.5F, -2, 0, 0.25F};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(m[i], expected[i], 1e-6) << i;
    EXPECT_THAT(scene.materials[0].uv_sets, ElementsAre(1U));
    EXPECT_THAT(scene.primitives.at(0).uvs[0], ElementsAre(0, 1, 0.2F, 0, 1, 1));
}

TEST(GltfTexture, TakesTexturesInsideExtensions) {
    GltfBuilder gltf = textured(plain_info, data_uri(png_file(2, 1, two_texels)));
    gltf.root["materials"][0]["extensions"]["KHR_materials_specular"] = {
        {"specularTexture", {{"index", 0}}},
        {"specularColorTexture",
         {{"index", 0},
          {"texCoord", 1},
          {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}}}};
    const Scene scene = load(gltf);
    const Material& material = scene.materials.at(0);
    EXPECT_FALSE(material.texture(TEXTURE_SPECULAR).srgb);
    EXPECT_TRUE(material.texture(TEXTURE_SPECULAR_COLOR).srgb);
    EXPECT_EQ(material.texture(TEXTURE_SPECULAR_COLOR).uvs, 1U);
    EXPECT_EQ(material.texture(TEXTURE_SPECULAR_COLOR).transform[2], 0.5F);
    EXPECT_THAT(scene.primitives.at(0).uvs[1], SizeIs(6));
}

TEST(GltfTexture, SaysWhatIsWrongWithAnImage) {
    const auto error = [](const Json& image) { return load_error(textured(plain_info, image)); };
    EXPECT_EQ(
        error({{"uri", "absent.png"}}),
        "scene.gltf: image 0 \"absent.png\": absent.png is missing, empty or cannot be read; put "
        "it "
        "beside the scene");
    EXPECT_EQ(
        error(data_uri("not an image at all")),
        "scene.gltf: image 0: is no PNG, JPEG or WebP image; convert it, or check that it is "
        "complete");
    const std::string png = png_file(8, 8, std::vector<uint8_t>(256, 77));
    EXPECT_THAT(
        error(data_uri(png.substr(0, png.size() - 20))), HasSubstr("image 0: is cut off; "));
    for (std::size_t at = 37; at < png.size() - 12; ++at) {  // the chunk of texels
        std::string damaged = png;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        EXPECT_THAT(error(data_uri(damaged)), HasSubstr("image 0: is damaged")) << at;
    }
    std::string overfull = jpeg_file(8, 8, std::vector<uint8_t>(256, 77));
    overfull[overfull.find("\xFF\xC4") + 5] = '\xFF';  // codes of one bit
    overfull[overfull.find("\xFF\xC4") + 6] = '\xFF';
    EXPECT_THAT(error(data_uri(overfull)), HasSubstr("Huffman"));
    const std::string jpeg = jpeg_file(64, 64, std::vector<uint8_t>(std::size_t{4} * 64 * 64, 77));
    EXPECT_THAT(
        error(data_uri(jpeg.substr(0, jpeg.size() - 9))), HasSubstr("image 0: is cut off; "));
    const std::string webp = webp_file();
    EXPECT_THAT(error(data_uri(webp.substr(0, webp.size() - 6))), HasSubstr("image 0: is "));
    GltfBuilder beyond = textured(plain_info, {});
    const int view = beyond.view(std::vector<char>(16));
    beyond.root["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
    beyond.root["bufferViews"][static_cast<std::size_t>(view)]["byteLength"] = 100000;
    EXPECT_THAT(load_error(beyond), HasSubstr("ends after its buffer"));
}

TEST(GltfTexture, SaysWhatIsWrongWithAReference) {
    const Json image = data_uri(png_file(2, 1, two_texels));
    EXPECT_THAT(
        load_error(textured({{"index", 4}}, image)),
        HasSubstr("material 0, baseColorTexture: refers to texture 4, but the file has 1 of them"));
    EXPECT_THAT(
        load_error(textured(plain_info, image, {{"source", 3}})),
        HasSubstr("texture 0: refers to image 3"));
    EXPECT_THAT(
        load_error(textured(plain_info, image, Json::object())),
        HasSubstr("texture 0: has no image of a kind that is supported"));
    GltfBuilder gltf = textured(plain_info, image, {{"source", 0}, {"sampler", 0}});
    gltf.root["samplers"] = {{{"wrapS", 5}}};
    EXPECT_THAT(load_error(gltf), HasSubstr("sampler 0: wrap mode 5 is unknown"));
    gltf.root["samplers"] = {{{"magFilter", 3}}};
    EXPECT_THAT(load_error(gltf), HasSubstr("sampler 0: magFilter 3 is unknown"));
}

TEST(GltfTexture, NotesMissingCoordinates) {
    GltfBuilder gltf =
        textured({{"index", 0}, {"texCoord", 3}}, data_uri(png_file(2, 1, two_texels)));
    const Scene scene = load(gltf);
    EXPECT_THAT(
        scene.ignored,
        ElementsAre("meshes without the texture coordinates they need (1): rendered with (0, 0)"));
    EXPECT_THAT(scene.primitives.at(0).uvs[0], ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST(GltfTexture, RefusesMoreTexelsThanAllowed) {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "scene.gltf",
        textured(plain_info, data_uri(png_file(8, 8, std::vector<uint8_t>(256, 77)))).text());
    EXPECT_EQ(load_gltf(path, "", 64).images.size(), 1U);
    EXPECT_THAT(
        error_of([&] { load_gltf(path, "", 63); }),
        HasSubstr("allowed; shrink them or raise --max-texels"));
}

TEST(GltfTexture, ReadsAlpha) {
    GltfBuilder gltf = textured(plain_info, data_uri(png_file(2, 1, two_texels)));
    Json& material = gltf.root["materials"][0];
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
    EXPECT_EQ(load(gltf).materials[0].alpha_mode, AlphaMode::opaque);
    material["alphaMode"] = "MASK";
    EXPECT_EQ(load(gltf).materials[0].alpha_mode, AlphaMode::mask);
    EXPECT_EQ(load(gltf).materials[0].alpha, 0.5F);
    EXPECT_EQ(load(gltf).materials[0].alpha_cutoff, 0.5F);
    material["alphaCutoff"] = 0.25;
    EXPECT_EQ(load(gltf).materials[0].alpha_cutoff, 0.25F);
    material["alphaMode"] = "BLEND";
    EXPECT_EQ(load(gltf).materials[0].alpha_mode, AlphaMode::blend);
    material["alphaMode"] = "SOMETIMES";
    EXPECT_THAT(load_error(gltf), HasSubstr("alphaMode \"SOMETIMES\" is unknown"));
}

TEST(GltfTexture, ReadsVertexAlphasWhereAlphaCounts) {
    GltfBuilder gltf = textured(plain_info, data_uri(png_file(2, 1, two_texels)));
    gltf.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        gltf.accessor<float>("VEC4", {1, 1, 1, 0.5, 1, 1, 1, 1, 1, 1, 1, 0.25});
    EXPECT_TRUE(load(gltf).primitives.at(0).alphas.empty());
    gltf.root["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_THAT(load(gltf).primitives.at(0).alphas, ElementsAre(0.5F, 1, 0.25F));
}

TEST(GltfTexture, UnlitMaterialsEmitTheirColour) {
    GltfBuilder gltf = textured(plain_info, data_uri(png_file(2, 1, two_texels)));
    Json& material = gltf.root["materials"][0];
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 1};
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    const Material unlit = load(gltf).materials.at(0);
    EXPECT_EQ(unlit.emission, (Rgb{0.5F, 0.25F, 1}));
    EXPECT_EQ(unlit.base_color, (Rgb{0, 0, 0}));
    EXPECT_EQ(unlit.texture(TEXTURE_EMISSION).image, 0U);
    EXPECT_EQ(unlit.specular, 0);
    EXPECT_EQ(unlit.metallic, 0);
}

}  // namespace
}  // namespace wavepath
