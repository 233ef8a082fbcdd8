#include "prepare/bvh_builder.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

namespace wavepath {
namespace {

// Walks the tree as the kernels do and checks what they rely on.
class Walk {
  public:
    Walk(const TestMesh& mesh, const Bvh& bvh) : mesh_(mesh), bvh_(bvh) {
        std::array<std::array<float, 2>, 3> all{};
        for (auto& axis : all) axis = {-1, 1};
        visit(0, all);
    }

    std::set<uint32_t> triangles;  // in some leaf
    std::size_t nodes = 0, blocks = 0, lanes = 0;
    std::size_t stack = 0;  // the most entries that may wait

  private:
    using Bounds = std::array<std::array<float, 2>, 3>;

    static Bounds box_of(const BvhNode& node, std::size_t child) {
        Bounds box{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            box[axis] = {node.bounds[axis][0][child], node.bounds[axis][1][child]};
        return box;
    }

    std::size_t visit(uint32_t index, const Bounds& outer) {
        require(index < bvh_.nodes.size());
        ++nodes;
        const BvhNode& node = bvh_.nodes[index];
        std::size_t children = 0;
        std::size_t deepest = 0;
        for (std::size_t child = 0; child < 8; ++child) {
            const Bounds box = box_of(node, child);
            if (node.children[child] == BVH_EMPTY) {
                for (const auto& [low, high] : box) EXPECT_GT(low, high);
                continue;
            }
            ++children;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                EXPECT_LE(outer[axis][0], box[axis][0]);
                EXPECT_GE(outer[axis][1], box[axis][1]);
            }
            if ((node.children[child] & BVH_LEAF) != 0)
                leaf(node.children[child] & ~BVH_LEAF, box);
            else
                deepest = std::max(deepest, visit(node.children[child], box));
        }
        const std::size_t needed =
            std::max(children, children + deepest - std::min<std::size_t>(children, 1));
        stack = std::max(stack, needed);
        return needed;
    }

    static void require(bool inside) {
        if (!inside) throw std::out_of_range("child of a BVH node");
    }

    void leaf(uint32_t index, const Bounds& box) {
        require(index < bvh_.blocks.size());
        ++blocks;
        const TriangleBlock& block = bvh_.blocks[index];
        for (std::size_t lane = 0; lane < 8; ++lane) {
            const uint32_t triangle = block.primitives[lane];
            if (triangle == BVH_EMPTY) {
                for (std::size_t axis = 0; axis < 3; ++axis)
                    EXPECT_EQ(block.vertices[0][axis][lane], block.vertices[1][axis][lane]);
                continue;
            }
            ASSERT_LT(triangle, mesh_.size());
            ++lanes;
            triangles.insert(triangle);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                float low = std::numeric_limits<float>::infinity();
                float high = -low;
                for (std::size_t vertex = 0; vertex < 3; ++vertex) {
                    const float x = block.vertices[vertex][axis][lane];
                    EXPECT_EQ(x, mesh_.positions[9 * std::size_t{triangle} + 3 * vertex + axis]);
                    low = std::min(low, x);
                    high = std::max(high, x);
                }
                // A part of the triangle lies in the box; all of it is checked by tracing rays at
                // it.
                EXPECT_LE(low, box[axis][1]);
                EXPECT_GE(high, box[axis][0]);
            }
        }
    }

    const TestMesh& mesh_;
    const Bvh& bvh_;
};

TEST(BvhBuilder, EveryTriangleIsInALeafAndEveryBoxHoldsIt) {
    for (const TestMesh& mesh :
         {box_mesh(), room_mesh(), sphere_mesh(20, 30), height_field_mesh(60), soup_mesh(3000),
          rods_mesh(500), repeated_mesh(box_mesh(), 200)}) {
        const Bvh bvh = build_bvh(mesh.positions);
        const Walk walk(mesh, bvh);
        EXPECT_EQ(walk.triangles.size(), mesh.size()) << mesh.name;
        EXPECT_EQ(walk.nodes, bvh.nodes.size()) << mesh.name;
        EXPECT_EQ(walk.blocks, bvh.blocks.size()) << mesh.name;
        EXPECT_LE(walk.stack, std::size_t{BVH_STACK}) << mesh.name;
    }
}

// Spatial splits are made where boxes overlap, and only there.
TEST(BvhBuilder, SplitsWhereItPays) {
    const auto lanes_per_triangle = [](const TestMesh& mesh) {
        const Bvh bvh = build_bvh(mesh.positions);
        return static_cast<double>(Walk(mesh, bvh).lanes) / static_cast<double>(mesh.size());
    };
    EXPECT_EQ(lanes_per_triangle(height_field_mesh(60)), 1.0);
    EXPECT_EQ(lanes_per_triangle(sphere_mesh(40, 40)), 1.0);
    EXPECT_GT(lanes_per_triangle(rods_mesh(500)), 1.1);
}

TEST(BvhBuilder, TrianglesWithoutAreaAreLeftOut) {
    TestMesh mesh = box_mesh();
    mesh.positions.insert(mesh.positions.end(), {0, 0, 0, 0, 0, 0, 0, 0, 0});  // a point
    mesh.positions.insert(
        mesh.positions.end(), {0, 0, 0, 0.1F, 0.2F, 0.3F, 0.2F, 0.4F, 0.6F});  // a line
    mesh.positions.insert(
        mesh.positions.end(), {0, 0, 0, 1e-20F, 0, 0, 0, 1e-20F, 0});  // small, not flat
    const Bvh bvh = build_bvh(mesh.positions);
    const Walk walk(mesh, bvh);
    EXPECT_EQ(walk.triangles.size(), 13U);
    EXPECT_TRUE(walk.triangles.contains(14));
}

// The kernels start at a node whatever there is.
TEST(BvhBuilder, FewTriangles) {
    EXPECT_EQ(build_bvh({}).nodes.size(), 1U);
    EXPECT_TRUE(build_bvh({}).blocks.empty());
    const TestMesh one{"one", {0, 0, 0, 0.5F, 0, 0, 0, 0.5F, 0}, false};
    const Bvh bvh = build_bvh(one.positions);
    EXPECT_EQ(bvh.nodes.size(), 1U);
    EXPECT_EQ(Walk(one, bvh).triangles.size(), 1U);
}

// A row of boxes turned by 45 or 135 degrees: corners that would be 0 are 4e-17, and a split there
// left a part so thin that Embree counted it on the other side, found this one empty and aborted.
TEST(BvhBuilder, TurnedBoxes) {
    const std::vector<float> box = box_mesh().positions;
    for (const std::size_t boxes : {1, 2, 12, 40})
        for (const double degrees : {45, 135, 60})
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double angle = degrees * std::numbers::pi / 180;
                const double size = 0.5 / static_cast<double>(boxes);
                TestMesh mesh{"turned", {}, false};
                for (std::size_t c = 0; c < boxes * box.size(); c += 3) {
                    std::array<double, 3> p{};
                    for (std::size_t k = 0; k < 3; ++k)
                        p[k] = std::copysign(0.5, box[c % box.size() + k]);
                    const double u = p[(axis + 1) % 3];
                    const double v = p[(axis + 2) % 3];
                    p[(axis + 1) % 3] = u * std::cos(angle) - v * std::sin(angle);
                    p[(axis + 2) % 3] = u * std::sin(angle) + v * std::cos(angle);
                    p[axis] += 1.5 * (static_cast<double>(c / box.size()) + 0.5 -
                                      0.5 * static_cast<double>(boxes));
                    for (const double x : p) mesh.positions.push_back(static_cast<float>(x * size));
                }
                const Bvh bvh = build_bvh(mesh.positions);
                EXPECT_EQ(Walk(mesh, bvh).triangles.size(), mesh.size());
            }
}

// Nothing to split by: the depth, and with it the kernels' stack, stays bounded.
TEST(BvhBuilder, ManyTrianglesInOnePlace) {
    const TestMesh mesh = repeated_mesh({"one", {0, 0, 0, 0.5F, 0, 0, 0, 0.5F, 0}, false}, 20'000);
    const Bvh bvh = build_bvh(mesh.positions);
    const Walk walk(mesh, bvh);
    EXPECT_EQ(walk.triangles.size(), mesh.size());
    EXPECT_LE(walk.stack, std::size_t{BVH_STACK});
}

}  // namespace
}  // namespace wavepath
