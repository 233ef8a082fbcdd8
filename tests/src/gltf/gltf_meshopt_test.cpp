#include "gltf/gltf_meshopt.h"

#include "support/gltf_builder.h"

#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <numeric>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;
using Bytes = std::vector<unsigned char>;

Bytes encode_vertices(const void* rows, std::size_t count, std::size_t stride) {
    Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), rows, count, stride));
    return bytes;
}

// A view that holds `encoded`, and stands for `count` rows of `stride` bytes in a buffer that the
// file lacks. Returns its index.
int add_compressed(
    GltfBuilder& gltf,
    const Bytes& encoded,
    std::size_t count,
    std::size_t stride,
    const Json& properties) {
    const int view = gltf.view(encoded);
    Json extension = {
        {"buffer", 0},
        {"byteOffset", gltf.root["bufferViews"][static_cast<std::size_t>(view)]["byteOffset"]},
        {"byteLength", encoded.size()},
        {"byteStride", stride},
        {"count", count}};
    extension.update(properties);
    return gltf.add(
        "bufferViews", {{"buffer", 1},
                        {"byteLength", count * stride},
                        {"extensions", {{"EXT_meshopt_compression", extension}}}});
}

int add_accessor(
    GltfBuilder& gltf, int view, int component_type, std::size_t count, const char* type) {
    return gltf.add(
        "accessors", {{"bufferView", view},
                      {"componentType", component_type},
                      {"count", count},
                      {"type", type},
                      {"normalized", component_type != 5126 && std::string(type) != "SCALAR"}});
}

// The text of `gltf` with a second buffer of these properties.
std::string with_fallback(const GltfBuilder& gltf, const Json& fallback) {
    Json root = Json::parse(gltf.text());
    root["buffers"].push_back(fallback);
    root["extensionsUsed"] = root["extensionsRequired"] = {"EXT_meshopt_compression"};
    return root.dump();
}

Scene load_compressed(const GltfBuilder& gltf) {
    const TemporaryFolder folder;
    return load_gltf(folder.write("scene.gltf", with_fallback(gltf, {{"byteLength", 4096}})));
}

const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.3F};

int add_corners(GltfBuilder& gltf) {
    const Bytes bytes = encode_vertices(corners.data(), 4, 12);
    return add_accessor(
        gltf, add_compressed(gltf, bytes, 4, 12, {{"mode", "ATTRIBUTES"}}), 5126, 4, "VEC3");
}

TEST(GltfMeshopt, ReadsVerticesAndIndices) {
    const std::vector<unsigned> indices{0, 1, 2, 2, 1, 3};
    for (const std::size_t stride : {2U, 4U})
        for (const char* mode : {"TRIANGLES", "INDICES"}) {
            Bytes bytes(256);
            bytes.resize(
                std::string(mode) == "INDICES"
                    ? meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), 6)
                    : meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), 6));
            GltfBuilder gltf;
            const int positions = add_corners(gltf);
            const int view = add_compressed(gltf, bytes, 6, stride, {{"mode", mode}});
            gltf.object(
                {{"attributes", {{"POSITION", positions}}},
                 {"indices", add_accessor(gltf, view, stride == 2 ? 5123 : 5125, 6, "SCALAR")}});
            const Scene scene = load_compressed(gltf);
            EXPECT_THAT(scene.ignored, IsEmpty());
            EXPECT_THAT(scene.primitives.at(0).positions, ElementsAreArray(corners));
            EXPECT_EQ(scene.primitives.at(0).indices.size(), 6U);
            if (std::string(mode) == "INDICES") {  // the other codec may turn triangles round
                EXPECT_THAT(scene.primitives.at(0).indices, ElementsAreArray(indices));
            }
        }
}

// The corners as rows of 12 bytes. Newer versions of the encoder take a mode besides: the first.
template <typename... Mode>
void encode_exponents(
    void (*encode)(void*, std::size_t, std::size_t, int, const float*, Mode...), Bytes& rows) {
    encode(rows.data(), 4, 12, 20, corners.data(), Mode{}...);
}

TEST(GltfMeshopt, AppliesFilters) {
    const std::vector<float> normals{0, 0, 1, 0, 0.6F, 0, 0.8F, 0, -1, 0, 0, 0, 0, -0.6F, 0.8F, 0};
    for (const std::size_t stride : {4U, 8U}) {
        Bytes rows(4 * stride);
        meshopt_encodeFilterOct(rows.data(), 4, stride, stride == 4 ? 8 : 16, normals.data());
        GltfBuilder gltf;
        const int positions = add_corners(gltf);
        const int view = add_compressed(
            gltf, encode_vertices(rows.data(), 4, stride), 4, stride,
            {{"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}});
        gltf.object(
            {{"attributes",
              {{"POSITION", positions},
               {"NORMAL", add_accessor(gltf, view, stride == 4 ? 5120 : 5122, 4, "VEC3")}}}});
        EXPECT_THAT(
            load_compressed(gltf).primitives.at(0).normals,
            Pointwise(
                FloatNear(stride == 4 ? 0.01F : 1e-4F),
                std::vector<float>{0, 0, 1, 0.6F, 0, 0.8F, -1, 0, 0, 0, -0.6F, 0.8F}));
    }
    Bytes rows(48);
    encode_exponents(meshopt_encodeFilterExp, rows);
    GltfBuilder gltf;
    const int view = add_compressed(
        gltf, encode_vertices(rows.data(), 4, 12), 4, 12,
        {{"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}});
    gltf.object({{"attributes", {{"POSITION", add_accessor(gltf, view, 5126, 4, "VEC3")}}}});
    EXPECT_THAT(
        load_compressed(gltf).primitives.at(0).positions, Pointwise(FloatNear(1e-5F), corners));
}

TEST(GltfMeshopt, AppliesTheQuaternionFilter) {
    const std::vector<float> quaternions{0, 0, 0, 1, 0, 0, 0.6F, 0.8F};
    Bytes rows(16);
    meshopt_encodeFilterQuat(rows.data(), 2, 8, 16, quaternions.data());
    GltfBuilder gltf;
    gltf.triangle();
    const int view = add_compressed(
        gltf, encode_vertices(rows.data(), 2, 8), 2, 8,
        {{"mode", "ATTRIBUTES"}, {"filter", "QUATERNION"}});
    gltf.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
        add_accessor(gltf, view, 5122, 2, "VEC4");
    const Scene scene = load_compressed(gltf);
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_NEAR(scene.instances[0].to_world[0], 1, 1e-3);
    EXPECT_NEAR(scene.instances[1].to_world[0], 1 - 2 * 0.36, 1e-3);
    EXPECT_NEAR(scene.instances[1].to_world[1], 2 * 0.48, 1e-3);
}

TEST(GltfMeshopt, NeedsNoFallbackBuffer) {
    GltfBuilder gltf;
    gltf.object({{"attributes", {{"POSITION", add_corners(gltf)}}}});
    const TemporaryFolder folder;
    const Json flag = {{"EXT_meshopt_compression", {{"fallback", true}}}};
    for (const Json& fallback :
         {Json{{"byteLength", 4096}}, Json{{"byteLength", 4096}, {"extensions", flag}},
          Json{{"byteLength", 4096}, {"uri", "absent.bin"}, {"extensions", flag}}}) {
        const auto file = folder.write("scene.gltf", with_fallback(gltf, fallback));
        EXPECT_EQ(error_of([&] { load_gltf(file); }), "") << fallback;
    }

    // In a .glb only the first buffer is the chunk.
    std::string bytes = gltf.binary();
    std::uint32_t json_size = 0;
    std::memcpy(&json_size, &bytes[12], 4);
    Json root = Json::parse(bytes.substr(20, json_size));
    root["buffers"].push_back({{"byteLength", 4096}});
    std::string json = root.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto new_size = static_cast<std::uint32_t>(json.size());
    bytes.replace(20, json_size, json);
    std::memcpy(&bytes[12], &new_size, 4);
    const auto total = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(&bytes[8], &total, 4);
    EXPECT_THAT(
        load_gltf(folder.write("scene.glb", bytes)).primitives.at(0).positions,
        ElementsAreArray(corners));
}

TEST(GltfMeshopt, RejectsWhatIsBroken) {
    const auto error = [](const Json& properties, std::size_t dropped = 0) {
        GltfBuilder gltf;
        const Bytes bytes = encode_vertices(corners.data(), 4, 12);
        const int view = add_compressed(
            gltf, Bytes(bytes.begin(), bytes.end() - static_cast<std::ptrdiff_t>(dropped)), 4, 12,
            {{"mode", "ATTRIBUTES"}});
        gltf.root["bufferViews"][static_cast<std::size_t>(view)]["extensions"]
                 ["EXT_meshopt_compression"]
                     .update(properties);
        gltf.object({{"attributes", {{"POSITION", add_accessor(gltf, view, 5126, 4, "VEC3")}}}});
        return error_of([&] { load_compressed(gltf); });
    };
    EXPECT_EQ(error(Json::object()), "");
    EXPECT_EQ(
        error(Json::object(), 3),
        "scene.gltf: bufferView 1, EXT_meshopt_compression: its data do not decode; the file is "
        "broken, export again");
    EXPECT_THAT(error({{"mode", "CLOUDS"}}), HasSubstr("mode \"CLOUDS\" is unknown"));
    EXPECT_THAT(error({{"mode", 3}}), HasSubstr("mode is 3, not a text"));
    EXPECT_THAT(error({{"mode", "TRIANGLES"}}), HasSubstr("does not allow 4 rows of 12 bytes"));
    EXPECT_THAT(error({{"byteStride", 260}}), HasSubstr("does not allow 4 rows of 260 bytes"));
    EXPECT_THAT(error({{"byteStride", 0}}), HasSubstr("does not allow 4 rows of 0 bytes"));
    EXPECT_THAT(error({{"count", -1}}), HasSubstr("count is -1, not an integer from 0 on"));
    EXPECT_THAT(error({{"count", 2000000000}}), HasSubstr("cannot hold 2000000000 rows of 12"));
    EXPECT_THAT(error({{"filter", "COLOR"}}), HasSubstr("filter \"COLOR\" is unknown"));
    EXPECT_THAT(
        error({{"filter", "OCTAHEDRAL"}}),
        HasSubstr("filter \"OCTAHEDRAL\" is unknown for mode ATTRIBUTES and rows of 12 bytes"));
    EXPECT_THAT(error({{"buffer", 9}}), HasSubstr("refers to buffer 9"));
    EXPECT_THAT(error({{"byteLength", 99999}}), HasSubstr("ends after its buffer of"));
}

}  // namespace
}  // namespace wavepath
