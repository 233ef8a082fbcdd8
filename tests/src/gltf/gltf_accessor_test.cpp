#include "gltf/gltf_accessor.h"

#include "support/case_files.h"
#include "support/gltf_builder.h"

#include <gmock/gmock.h>

#include <cstring>
#include <limits>

namespace wavepath {
namespace {

using Json = GltfBuilder::Json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

Scene load_positions(GltfBuilder& gltf, int accessor) {
    gltf.object({{"attributes", {{"POSITION", accessor}}}});
    return load(gltf);
}

template <typename T>
class IndexTypes : public testing::Test {};
using AllIndexTypes = testing::Types<std::uint8_t, std::uint16_t, std::uint32_t>;
TYPED_TEST_SUITE(IndexTypes, AllIndexTypes);

TYPED_TEST(IndexTypes, AreRead) {
    GltfBuilder gltf;
    const int indices = gltf.accessor<TypeParam>("SCALAR", {2, 0, 1});
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}}}, {"indices", indices}});
    EXPECT_THAT(load(gltf).primitives.at(0).indices, ElementsAre(2, 0, 1));
}

TYPED_TEST(IndexTypes, RejectTheRestartValue) {
    GltfBuilder gltf;
    const int indices =
        gltf.accessor<TypeParam>("SCALAR", {0, 1, std::numeric_limits<TypeParam>::max()});
    const std::vector<float> positions(900);
    gltf.object(
        {{"attributes", {{"POSITION", gltf.accessor("VEC3", positions)}}}, {"indices", indices}});
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: mesh 0, primitive 0, indices: index 2 is the primitive restart value; split "
        "the primitive");
}

template <typename T>
class IntegerPositions : public testing::Test {};
using AllIntegerTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t>;
TYPED_TEST_SUITE(IntegerPositions, AllIntegerTypes);

TYPED_TEST(IntegerPositions, AreTakenAsTheyAre) {
    GltfBuilder gltf;
    const std::vector<TypeParam> values{
        0, 1, 2, 3, 4, 5, 6, 7, std::numeric_limits<TypeParam>::min()};
    const Scene scene = load_positions(gltf, gltf.accessor("VEC3", values));
    EXPECT_THAT(
        scene.primitives.at(0).positions,
        ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, std::numeric_limits<TypeParam>::min()));
}

TYPED_TEST(IntegerPositions, AreFractionsWhereNormalized) {
    using Limits = std::numeric_limits<TypeParam>;
    GltfBuilder gltf;
    const std::vector<TypeParam> values{Limits::max(), 0, 1, Limits::min(), 0, 0, 0,
                                        Limits::max(), 0};
    const Scene scene = load_positions(gltf, gltf.accessor("VEC3", values, {{"normalized", true}}));
    const float unit = 1 / static_cast<float>(Limits::max());
    const float least = std::is_signed_v<TypeParam> ? -1 : 0;
    EXPECT_THAT(scene.primitives.at(0).positions, ElementsAre(1, 0, unit, least, 0, 0, 0, 1, 0));
}

TEST(GltfAccessor, ReadsInterleavedAttributes) {
    GltfBuilder gltf;
    const int view = gltf.view<float>({0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 2, 0, 0, 1, 0, 2, 0, 0}, 24);
    const auto attribute = [&](int offset) {
        return gltf.add(
            "accessors", {{"bufferView", view},
                          {"byteOffset", offset},
                          {"componentType", 5126},
                          {"count", 3},
                          {"type", "VEC3"}});
    };
    gltf.object({{"attributes", {{"POSITION", attribute(0)}, {"NORMAL", attribute(12)}}}});
    const Scene scene = load(gltf);
    EXPECT_THAT(scene.primitives.at(0).positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
    EXPECT_THAT(scene.primitives.at(0).normals, ElementsAre(0, 0, 1, 0, 1, 0, 1, 0, 0));
}

Json sparse(
    GltfBuilder& gltf, const std::vector<std::uint16_t>& rows, const std::vector<float>& values) {
    return {
        {"count", rows.size()},
        {"indices", {{"bufferView", gltf.view(rows)}, {"componentType", 5123}}},
        {"values", {{"bufferView", gltf.view(values)}}}};
}

TEST(GltfAccessor, ReplacesSparseRows) {
    GltfBuilder gltf;
    const Json replaced = sparse(gltf, {0, 2}, {7, 8, 9, 4, 5, 6});
    const int positions =
        gltf.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}, {{"sparse", replaced}});
    EXPECT_THAT(
        load_positions(gltf, positions).primitives.at(0).positions,
        ElementsAre(7, 8, 9, 1, 0, 0, 4, 5, 6));
}

// Not allowed, but nothing is lost by reading them.
TEST(GltfAccessor, ReadsRowsAtOddOffsets) {
    GltfBuilder gltf;
    const std::vector<float> corners{1, 2, 3, 4, 5, 6, 7, 9, 8};
    std::vector<std::uint8_t> bytes(1 + corners.size() * sizeof(float));
    std::memcpy(&bytes[1], corners.data(), corners.size() * sizeof(float));
    const int positions = gltf.accessor<std::uint8_t>("SCALAR", bytes);
    Json& accessor = gltf.root["accessors"][static_cast<std::size_t>(positions)];
    accessor["type"] = "VEC3";
    accessor["componentType"] = 5126;
    accessor["byteOffset"] = 1;
    accessor["count"] = 3;
    EXPECT_EQ(load_positions(gltf, positions).primitives.at(0).positions, corners);
}

TEST(GltfAccessor, IsZeroWhereSparseRowsHaveNoBase) {
    GltfBuilder gltf;
    const int positions = gltf.add(
        "accessors", {{"componentType", 5126},
                      {"count", 3},
                      {"type", "VEC3"},
                      {"sparse", sparse(gltf, {1, 2}, {1, 0, 0, 0, 1, 0})}});
    EXPECT_THAT(
        load_positions(gltf, positions).primitives.at(0).positions,
        ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
}

TEST(GltfAccessor, ReplacesSparseIndices) {
    GltfBuilder gltf;
    const Json replaced = {
        {"count", 1},
        {"indices", {{"bufferView", gltf.view<std::uint8_t>({2})}, {"componentType", 5121}}},
        {"values", {{"bufferView", gltf.view<std::uint8_t>({1})}}}};
    const int indices = gltf.accessor<std::uint8_t>("SCALAR", {0, 2, 9}, {{"sparse", replaced}});
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}}}, {"indices", indices}});
    EXPECT_THAT(load(gltf).primitives.at(0).indices, ElementsAre(0, 2, 1));
}

// A triangle with 16-bit indices, then broken by `change`.
struct Broken {
    const char* name;
    void (*change)(Json& root);
    const char* message;
};

std::ostream& operator<<(std::ostream& stream, const Broken& broken) {
    return stream << broken.name;
}

class BrokenAccessors : public testing::TestWithParam<Broken> {};

TEST_P(BrokenAccessors, AreNamed) {
    GltfBuilder gltf;
    const int positions = gltf.triangle_positions();
    const Json replaced = sparse(gltf, {0, 1}, {0, 0, 0, 1, 0, 0});
    const int indices = gltf.accessor<std::uint16_t>("SCALAR", {0, 1, 2});
    gltf.object({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    gltf.root["accessors"][0]["sparse"] = replaced;
    ASSERT_EQ(load_error(gltf), "");
    GetParam().change(gltf.root);
    EXPECT_THAT(load_error(gltf), testing::StartsWith("scene.gltf: "));
    EXPECT_THAT(load_error(gltf), HasSubstr(GetParam().message));
}

constexpr Broken broken_accessors[] = {
    {"view_missing", [](Json& root) { root["accessors"][0]["bufferView"] = 9; },
     "mesh 0, primitive 0, POSITION: refers to bufferView 9, but the file has 4 of them"},
    {"view_past_buffer", [](Json& root) { root["bufferViews"][0]["byteLength"] = 4096; },
     "bufferView 0: ends after its buffer of 72 bytes"},
    {"view_offset_past_buffer",
     [](Json& root) { root["bufferViews"][0]["byteOffset"] = 18446744073709551612U; },
     "bufferView 0: ends after its buffer"},
    {"buffer_missing", [](Json& root) { root["bufferViews"][0]["buffer"] = 1; },
     "bufferView 0: refers to buffer 1"},
    {"stride_below_row", [](Json& root) { root["bufferViews"][0]["byteStride"] = 8; },
     "bufferView 0: byteStride 8 is less than the 12 bytes of a row"},
    {"count_past_view", [](Json& root) { root["accessors"][0]["count"] = 4; },
     "POSITION: 4 rows from byte 0 end after bufferView 0 of 36 bytes"},
    {"count_overflows",
     [](Json& root) { root["accessors"][0]["count"] = 1537228672809129302U; },  // x 12 wraps to 8
     "POSITION: 1537228672809129302 rows from byte 0 end after bufferView 0"},
    {"offset_past_view", [](Json& root) { root["accessors"][0]["byteOffset"] = 40; },
     "POSITION: 3 rows from byte 40 end after bufferView 0"},
    {"offset_overflows",
     [](Json& root) { root["accessors"][0]["byteOffset"] = 18446744073709551612U; },
     "end after bufferView 0"},
    {"no_rows", [](Json& root) { root["accessors"][0]["count"] = 0; }, "POSITION: holds no rows"},
    {"many_rows_without_view",
     [](Json& root) {
         root["accessors"][0].erase("bufferView");
         root["accessors"][0]["count"] = 4000000000U;
     },
     "POSITION: 4000000000 rows without a bufferView are more than the 16777216 allowed"},
    {"type", [](Json& root) { root["accessors"][0]["type"] = "VEC2"; },
     "accessor 0 does not hold 3 numbers a row"},
    {"component_type", [](Json& root) { root["accessors"][0]["componentType"] = 5130; },
     "accessor 0 has component type 5130"},
    {"index_component_type", [](Json& root) { root["accessors"][1]["componentType"] = 5122; },
     "accessor 1 is no SCALAR of UNSIGNED_BYTE, _SHORT or _INT"},
    {"index_type", [](Json& root) { root["accessors"][1]["type"] = "VEC2"; },
     "accessor 1 is no SCALAR"},
    {"sparse_count_negative", [](Json& root) { root["accessors"][0]["sparse"]["count"] = -1; },
     "sparse.count is -1, not an integer"},
    {"sparse_count_too_large", [](Json& root) { root["accessors"][0]["sparse"]["count"] = 4; },
     "sparse count 4 is not in 1 .. 3"},
    {"sparse_past_view",
     [](Json& root) { root["accessors"][0]["sparse"]["values"]["byteOffset"] = 4; },
     "POSITION: 2 rows from byte 4 end after bufferView 2 of 24 bytes"},
    {"sparse_offset_negative",
     [](Json& root) { root["accessors"][0]["sparse"]["indices"]["byteOffset"] = -1; },
     "sparse.indices.byteOffset is -1, not an integer from 0 on"},
    {"sparse_component_type",
     [](Json& root) { root["accessors"][0]["sparse"]["indices"]["componentType"] = 5126; },
     "sparse indices have component type 5126"},
    {"sparse_view_missing",
     [](Json& root) { root["accessors"][0]["sparse"]["values"]["bufferView"] = -1; },
     "sparse.values.bufferView is -1, not an integer"},
    {"sparse_index_past_count",
     [](Json& root) {  // reads 0x0000, then the low half of 1.0F
         root["accessors"][0]["sparse"]["indices"]["bufferView"] = 0;
         root["accessors"][0]["sparse"]["indices"]["byteOffset"] = 12;
     },
     "sparse index 16256 is not below the count 3"},
    {"sparse_indices_unsorted",
     [](Json& root) {  // 0x0000 twice
         root["accessors"][0]["sparse"]["count"] = 2;
         root["accessors"][0]["sparse"]["indices"]["bufferView"] = 0;
         root["accessors"][0]["sparse"]["indices"]["byteOffset"] = 0;
     },
     "sparse index 0 does not follow the one before it"},
};

INSTANTIATE_TEST_SUITE_P(
    GltfAccessor, BrokenAccessors, testing::ValuesIn(broken_accessors), [](const auto& info) {
        return std::string(info.param.name);
    });

TEST(GltfAccessor, RejectsAnIndexPastTheVertices) {
    GltfBuilder gltf;
    const int indices = gltf.accessor<std::uint8_t>("SCALAR", {0, 1, 3});
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}}}, {"indices", indices}});
    EXPECT_EQ(
        load_error(gltf),
        "scene.gltf: mesh 0, primitive 0, indices: index 2 is 3, but there are 3 vertices; repair "
        "the mesh and export again");
}

TEST(GltfAccessor, RejectsNumbersThatAreNotFinite) {
    for (const float value : {nan, infinity, -infinity}) {
        GltfBuilder gltf;
        gltf.object(
            {{"attributes",
              {{"POSITION", gltf.accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, value, 0})}}}});
        EXPECT_EQ(
            load_error(gltf),
            "scene.gltf: mesh 0, primitive 0, POSITION: row 2 is not finite; repair the mesh and "
            "export again");
    }
}

TEST(GltfAccessor, NamesTheRowOfANormalThatIsNone) {
    const auto folder = case_folder("nan-normals");
    if (folder.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    EXPECT_EQ(
        error_of([&] { load_gltf(folder / "one_nan_normal.gltf"); }),
        "one_nan_normal.gltf: mesh 0, primitive 0, NORMAL: row 20 is not finite; repair the mesh "
        "and export again");
}

}  // namespace
}  // namespace wavepath
