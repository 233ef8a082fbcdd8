#include "gltf/tangents.h"

#include "gltf/gltf_loader.h"
#include "scene/transform.h"
#include "support/sample_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace wavepath {
namespace {

// The unit square in the plane z = 0, v down, as two triangles that share an edge.
Primitive square(bool mirrored) {
    Primitive p;
    p.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    p.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    p.indices = {0, 1, 2, 0, 2, 3};
    for (std::size_t i = 0; i < 4; ++i) {
        const float u = p.positions[3 * i];
        p.uvs[0].push_back(mirrored ? 1 - u : u);
        p.uvs[0].push_back(1 - p.positions[3 * i + 1]);
    }
    return p;
}

TEST(Tangents, PointAlongU) {
    for (const bool mirrored : {false, true}) {
        const Primitive p = square(mirrored);
        const std::vector<float> tangents = derive_tangents(p, p.uvs[0]);
        ASSERT_EQ(tangents.size(), 24U);
        for (std::size_t corner = 0; corner < 6; ++corner) {
            EXPECT_NEAR(tangents[4 * corner], mirrored ? -1 : 1, 1e-6);
            EXPECT_NEAR(tangents[4 * corner + 1], 0, 1e-6);
            EXPECT_NEAR(tangents[4 * corner + 2], 0, 1e-6);
            // bitangent = sign * cross(normal, tangent) points up the picture
            EXPECT_EQ(tangents[4 * corner + 3], mirrored ? -1 : 1);
        }
    }
}

// Across a seam where u turns round each side keeps its own.
TEST(Tangents, AreNotMixedAcrossMirroredCoordinates) {
    Primitive p;
    p.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0};
    p.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    p.indices = {0, 1, 2, 1, 3, 2};
    p.uvs[0] = {0, 1, 1, 1, 1, 0, 0, 1};
    const std::vector<float> tangents = derive_tangents(p, p.uvs[0]);
    EXPECT_NEAR(tangents[4], 1, 1e-6);
    EXPECT_NEAR(tangents[12], -1, 1e-6);
    EXPECT_EQ(tangents[7], 1);
    EXPECT_EQ(tangents[15], -1);
}

// Two faces at a right angle share two vertices: there the tangents lie in the plane of the common
// normal, weighed alike.
TEST(Tangents, AreTheMeanAroundAVertexInThePlaneOfItsNormal) {
    Primitive p;
    const float h = std::sqrt(0.5F);
    p.positions = {-1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, -1};
    p.normals = {0, 0, 1, h, 0, h, h, 0, h, 1, 0, 0};
    p.indices = {0, 1, 2, 1, 3, 2};
    p.uvs[0] = {0, 1, 0.5F, 1, 0.5F, 0, 1, 1};
    const std::vector<float> tangents = derive_tangents(p, p.uvs[0]);
    EXPECT_NEAR(tangents[4], h, 1e-6);
    EXPECT_NEAR(tangents[5], 0, 1e-6);
    EXPECT_NEAR(tangents[6], -h, 1e-6);
    EXPECT_NEAR(tangents[0], 1, 1e-6);
}

TEST(Tangents, AreSomethingWhereCoordinatesSayNothing) {
    Primitive p = square(false);
    std::ranges::fill(p.uvs[0], 0.5F);
    const std::vector<float> tangents = derive_tangents(p, p.uvs[0]);
    for (std::size_t corner = 0; corner < 6; ++corner) {
        const Vec3d t{tangents[4 * corner], tangents[4 * corner + 1], tangents[4 * corner + 2]};
        EXPECT_NEAR(dot(t, t), 1, 1e-6);
        EXPECT_NEAR(t[2], 0, 1e-6);
    }
}

// Those that an exporter wrote with MikkTSpace, against ours: nearly all within a degree.
TEST(Tangents, AreThoseOfMikkTSpaceOnASampleModel) {
    const auto path = asset_folder() / "models" / "LightsPunctualLamp" / "LightsPunctualLamp.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no sample models";
    const Scene scene = load_gltf(path);
    std::size_t corners = 0;
    std::size_t close = 0;
    std::size_t signs = 0;
    for (const Primitive& p : scene.primitives) {
        if (p.tangents.empty()) continue;
        const Texture& normal = scene.materials[p.material].texture(TEXTURE_NORMAL);
        const std::vector<float> ours = derive_tangents(p, p.uvs[normal.uvs]);
        for (std::size_t i = 0; i < ours.size(); i += 4, ++corners) {
            const float* a = &ours[i];
            const float* b = &p.tangents[i];
            close += a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > std::cos(0.0175) ? 1 : 0;
            signs += a[3] == b[3] ? 1 : 0;
        }
    }
    RecordProperty("corners", static_cast<int>(corners));
    RecordProperty("within_a_degree", static_cast<int>(close));
    RecordProperty("signs", static_cast<int>(signs));
    ASSERT_GT(corners, 1000U);
    EXPECT_GE(close, corners * 99 / 100) << corners << " corners, " << signs << " signs alike";
    EXPECT_EQ(signs, corners);
}

}  // namespace
}  // namespace wavepath
