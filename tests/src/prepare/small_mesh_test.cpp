#include "prepare/small_mesh.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <bit>

namespace wavepath {
namespace {

// Exact: every corner's bits, in scene order.
void expect_same_triangles(const SmallMesh& mesh, const std::vector<float>& positions) {
    ASSERT_EQ(mesh.triangle_count, positions.size() / 9);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const uint32_t corner = mesh.triangles[i / 9][i / 3 % 3];
        ASSERT_LT(corner, mesh.corner_count);
        EXPECT_EQ(
            std::bit_cast<uint32_t>(mesh.corners[i % 3][corner]),
            std::bit_cast<uint32_t>(positions[i]))
            << "coordinate " << i;
    }
}

TEST(SmallMesh, ListsSharedCornersOnce) {
    const std::vector<float> box = box_mesh().positions;
    const std::optional<SmallMesh> mesh = small_mesh(box);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->corner_count, 8U);
    expect_same_triangles(*mesh, box);
}

TEST(SmallMesh, KeepsTheSignOfZero) {
    const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, -0.0F};
    const std::optional<SmallMesh> mesh = small_mesh(triangle);
    ASSERT_TRUE(mesh);
    expect_same_triangles(*mesh, triangle);
}

TEST(SmallMesh, RefusesMoreThanItHolds) {
    std::vector<float> fan;  // round one corner
    const auto add = [&](float x) { fan.insert(fan.end(), {0, 0, 1, x, 0, 0, x + 1, 0, 0}); };
    for (int k = 0; k < SMALL_MESH_CORNERS - 2; ++k) add(static_cast<float>(k));
    const std::optional<SmallMesh> full = small_mesh(fan);
    ASSERT_TRUE(full);
    EXPECT_EQ(full->corner_count, SMALL_MESH_CORNERS);
    expect_same_triangles(*full, fan);
    add(SMALL_MESH_CORNERS - 2);
    EXPECT_FALSE(small_mesh(fan)) << "one corner too many";

    std::vector<float> repeated;
    for (int k = 0; k < SMALL_MESH_TRIANGLES; ++k)
        repeated.insert(repeated.end(), {0, 0, 1, 0, 1, 0, 1, 0, 0});
    EXPECT_TRUE(small_mesh(repeated));
    repeated.insert(repeated.end(), {0, 0, 1, 0, 1, 0, 1, 0, 0});
    EXPECT_FALSE(small_mesh(repeated)) << "one triangle too many";
}

}  // namespace
}  // namespace wavepath
