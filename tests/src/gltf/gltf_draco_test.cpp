#include "gltf/gltf_draco.h"

#include "support/gltf_builder.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>

#include <set>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::HasSubstr;
using testing::IsEmpty;

// Two triangles of a square with a color a corner. Returns the encoded bytes; attribute 0 holds
// positions, 1 colors.
std::vector<unsigned char> encoded_square() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int positions =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int colors = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
    const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::uint8_t c[4][4] = {
        {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {51, 51, 51, 255}};
    const auto face = [&](unsigned index, int i, int j, int k) {
        const draco::FaceIndex at(index);
        builder.SetAttributeValuesForFace(positions, at, p[i], p[j], p[k]);
        builder.SetAttributeValuesForFace(colors, at, c[i], c[j], c[k]);
    };
    face(0, 0, 1, 2);
    face(1, 0, 2, 3);
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

// The square, its accessors without data.
struct CompressedSquare : GltfBuilder {
    explicit CompressedSquare(const std::vector<unsigned char>& bytes) {
        const int positions =
            add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
        const int colors =
            add("accessors",
                {{"componentType", 5121}, {"count", 4}, {"type", "VEC4"}, {"normalized", true}});
        const int indices =
            add("accessors", {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
        object(
            {{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}},
             {"indices", indices},
             {"extensions",
              {{"KHR_draco_mesh_compression",
                {{"bufferView", view(bytes)},
                 {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}}}}}});
        root["extensionsUsed"] = root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    }

    Json& extension() {
        return root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
    }
};

// The corners as (x, y, red, green): Draco is free to order them.
std::multiset<std::vector<float>> corners(const Primitive& primitive) {
    std::multiset<std::vector<float>> result;
    for (const std::size_t i : primitive.indices)
        result.insert(
            {std::round(1000 * primitive.positions[3 * i]) / 1000,
             std::round(1000 * primitive.positions[3 * i + 1]) / 1000, primitive.colors[3 * i],
             primitive.colors[3 * i + 1]});
    return result;
}

TEST(GltfDraco, ReadsTrianglesWithTheirAttributes) {
    const CompressedSquare gltf(encoded_square());
    const Scene scene = load(gltf);
    EXPECT_THAT(scene.ignored, IsEmpty());
    EXPECT_EQ(scene.triangle_count(), 2U);
    const std::vector<float> a{0, 0, 1, 0}, b{1, 0, 0, 1}, c{1, 1, 0, 0}, d{0, 1, 0.2F, 0.2F};
    EXPECT_EQ(
        corners(scene.primitives.at(0)), (std::multiset<std::vector<float>>{a, b, c, a, c, d}));
}

TEST(GltfDraco, PrefersTheCompressedData) {
    CompressedSquare gltf(encoded_square());
    gltf.root.erase("extensionsRequired");
    Json& primitive = gltf.root["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = gltf.triangle_positions();
    primitive["indices"] = gltf.accessor<std::uint8_t>("SCALAR", {0, 1, 2});
    EXPECT_EQ(load(gltf).triangle_count(), 2U);
}

TEST(GltfDraco, RejectsWhatIsBroken) {
    const auto error = [](const auto& breaks) {
        CompressedSquare gltf(encoded_square());
        breaks(gltf);
        return load_error(gltf);
    };
    EXPECT_THAT(
        error([](auto& gltf) { gltf.root["bufferViews"][0]["byteLength"] = 20; }),
        testing::StartsWith("scene.gltf: mesh 0, primitive 0, KHR_draco_mesh_compression: its data "
                            "do not decode ("));
    EXPECT_THAT(
        error([](auto& gltf) { gltf.extension().erase("bufferView"); }),
        HasSubstr("bufferView is no integer"));
    EXPECT_THAT(
        error([](auto& gltf) { gltf.extension().erase("attributes"); }),
        HasSubstr("has no attributes"));
    EXPECT_THAT(
        error([](auto& gltf) { gltf.extension()["attributes"]["POSITION"] = 5; }),
        HasSubstr("its data hold no attribute 5"));
    EXPECT_THAT(
        error([](auto& gltf) { gltf.extension()["attributes"]["NORMAL"] = 0; }),
        HasSubstr("compresses NORMAL, which the primitive lacks"));
    EXPECT_THAT(
        error([](auto& gltf) { gltf.root["accessors"][1]["componentType"] = 5125; }),
        HasSubstr("COLOR_0 has component type 5125"));
}

// Every byte in turn: libdraco is fed files from anywhere.
TEST(GltfDraco, SurvivesBrokenData) {
    const std::vector<unsigned char> bytes = encoded_square();
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (const int flip : {0x01, 0x80, 0xFF}) {
            std::vector<unsigned char> broken = bytes;
            broken[i] = static_cast<unsigned char>(broken[i] ^ flip);
            const std::string error = load_error(CompressedSquare(broken));
            if (!error.empty()) {
                EXPECT_THAT(error, HasSubstr("mesh 0"));
            }
        }
}

}  // namespace
}  // namespace wavepath
