#include "prepare/subdivide.h"

#include "prepare/bvh_builder.h"
#include "prepare/normalise.h"
#include "scene/transform.h"
#include "support/probe.h"
#include "support/ray_oracle.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace wavepath {
namespace {

using Point = std::array<float, 3>;

double length(const Vec3d& v) {
    return std::sqrt(dot(v, v));
}

Vec3d normal_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return cross(minus(b, a), minus(c, a));
}

Point corner_of(const NormalisedScene& geometry, std::size_t corner) {
    const float* p = &geometry.positions[3 * corner];
    return {p[0], p[1], p[2]};
}

TEST(Subdivide, LeavesTheUnitCubeAlone) {
    EXPECT_EQ(pieces_of({{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {0.5, -0.5, 0.5}}}).size(), 1U);
    EXPECT_EQ(pieces_of({{{1e5, 0, 0}, {1.5e5, 1e5, 0}, {1e5, 0, 1.5e5}}}).size(), 1U)
        << "nor what is far off and small beside that";
}

TEST(Subdivide, MakesPiecesSmallBesideTheirDistance) {
    const std::array<Vec3d, 3> triangles[] = {
        {{{-1e6, -0.1, 1e6}, {1e6, -0.1, 1e6}, {0, -0.1, -1e6}}},
        {{{1e7, 3e6, 2e6}, {-1e7, 1e6, 4e6}, {2e5, -8e6, -9e6}}},
        {{{0, 0, 0}, {0.01, 0, 0}, {1e6, 2e6, -3e6}}}};
    for (const auto& corners : triangles) {
        const Vec3d whole_normal = normal_of(corners[0], corners[1], corners[2]);
        const std::vector<Piece> pieces = pieces_of(corners);
        EXPECT_LT(pieces.size(), 2000U);
        double area = 0;
        for (const Piece& piece : pieces) {
            const Vec3d normal = normal_of(piece[0].position, piece[1].position, piece[2].position);
            EXPECT_GT(dot(normal, whole_normal), 0) << "it turns as the triangle does";
            area += length(normal);
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3d& a = piece[k].position;
                const Vec3d& b = piece[(k + 1) % 3].position;
                EXPECT_LE(length(minus(a, b)), std::max(1.75, 2 * std::min(length(a), length(b))));
                Vec3d blended{0, 0, 0};
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        blended[axis] += piece[k].weights[c] * corners[c][axis];
                EXPECT_LT(length(minus(blended, a)), 1e-8);
            }
        }
        EXPECT_NEAR(area / length(whole_normal), 1, 1e-9);
    }
}

// Every edge is run through as often one way as the other, corners compared bit by bit.
TEST(Subdivide, KeepsMeshesClosed) {
    Scene scene = scene_named("far box");
    add_box(scene, lambert(grey(0.5F)), {-1e6, -0.3, -2e5}, {1.3e6, 7e5, 0.4}, Facing::outward);
    const NormalisedScene geometry = normalise(scene, Extent{{0.1, 0.2, 0.3}, 2});
    EXPECT_TRUE(geometry.is_far());
    EXPECT_GT(geometry.triangle_count(), 100U);
    std::map<std::pair<Point, Point>, int> edges;
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const Point a = corner_of(geometry, 3 * t + k);
            const Point b = corner_of(geometry, 3 * t + (k + 1) % 3);
            edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    EXPECT_TRUE(std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; }));
}

TEST(Subdivide, BlendsWhatCornersHave) {
    Scene scene = scene_named("attributes");
    Primitive& ground =
        add_quad(scene, lambert(grey(0.5F)), {-1e5, 0, 1e5}, {2e5, 0, 0}, {0, 0, -2e5});
    ground.uvs[0] = {0, 0, 8, 0, 8, 4, 0, 4};
    ground.colors = {0, 0, 0, 1, 0, 0, 1, 0.5F, 0, 0, 0.5F, 0};
    ground.normals = {0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0};
    const NormalisedScene geometry = normalise(scene, Extent{{0, 0, 0}, 1});
    ASSERT_EQ(geometry.uvs[0].size(), 6 * geometry.triangle_count());
    ASSERT_EQ(geometry.normals.size(), geometry.positions.size());
    ASSERT_EQ(geometry.colors.size(), geometry.positions.size());
    for (std::size_t corner = 0; corner < 3 * geometry.triangle_count(); ++corner) {
        const Point p = corner_of(geometry, corner);
        const double across = (double{p[0]} + 1e5) / 2e5;
        const double up = (1e5 - double{p[2]}) / 2e5;
        EXPECT_NEAR(geometry.uvs[0][2 * corner], 8 * across, 1e-6);
        EXPECT_NEAR(geometry.uvs[0][2 * corner + 1], 4 * up, 1e-6);
        EXPECT_NEAR(geometry.colors[3 * corner], across, 1e-6);
        EXPECT_NEAR(geometry.colors[3 * corner + 1], 0.5 * up, 1e-6);
        EXPECT_NEAR(geometry.normals[3 * corner], up, 1e-6) << "linear, as it is interpolated";
    }
}

constexpr const char* meet = R"(
kernel void meet(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const float* r = rays + 6 * i;
    const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), INFINITY);
    out[i] = closest_hit(make_tree(nodes, blocks), &ray, at_origin(), 0);
}
)";

struct Plane {
    Vec3d point, normal;  // unit

    double height(const Vec3d& p) const { return dot(normal, minus(p, point)); }
};

// Rays from above a plane, from close to the origin and from far off, to points of it at all
// distances up to a twentieth of `size`: 6 floats each.
std::vector<float> rays_at(const Plane& plane, double size, std::size_t count) {
    std::mt19937 random(7);
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> uniform;
    const auto at_height = [&](double reach, double height) {
        Vec3d p;
        for (double& x : p) x = reach * gauss(random);
        const double rise = height - plane.height(p);
        for (std::size_t k = 0; k < 3; ++k) p[k] += rise * plane.normal[k];
        return p;
    };
    std::vector<float> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const double reach = i % 2 == 0 ? 1 : std::pow(size / 50, uniform(random));
        const Vec3d origin = at_height(reach, 0.3 * reach);
        const Vec3d aim = at_height(0.1 * std::pow(size / 5, uniform(random)), 0);
        for (const double x : origin) rays.push_back(static_cast<float>(x));
        for (const double x : normalized(minus(aim, origin))) rays.push_back(static_cast<float>(x));
    }
    return rays;
}

// No ray slips through between the pieces of a plane, and what is hit lies in the plane, as it is
// known in double, within a fourth of the offset of rays there. So does the end of the ray, within
// what rounding of its start and its end allows.
TEST(Subdivide, PlanesAreHitWhereTheyAre) {
    const Probe probe({"geometry/bvh.cl"}, meet);
    for (const float size : {1e3F, 1e5F, 1e7F}) {
        Scene scene = scene_named("plane");
        add_triangles(
            scene, lambert(grey(0.5F)),
            {-size, -0.1F * size, size, size, 0.2F * size, 0.9F * size, 0, -0.04F * size, -size},
            {0, 1, 2});
        const std::vector<float>& corners = scene.primitives[0].positions;
        const Vec3d a = vec3_at(corners, 0);
        const Plane plane{a, normalized(normal_of(a, vec3_at(corners, 1), vec3_at(corners, 2)))};
        // the origin: 0.4 above it
        Extent extent{{0, 0, 0}, 1};
        const double height = plane.height({0, 0, 0});
        for (std::size_t k = 0; k < 3; ++k) extent.centre[k] = (0.4 - height) * plane.normal[k];
        const NormalisedScene geometry = normalise(scene, extent);
        const Plane here{minus(a, extent.centre), plane.normal};
        const Bvh bvh = build_bvh(geometry.positions);
        const std::size_t count = scaled(20000);
        const std::vector<float> rays = rays_at(here, size, count);
        const auto hits = probe.run<TestHit>("meet", count, count, rays, bvh.nodes, bvh.blocks);
        double farthest = 0;
        double end_farthest = 0;
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_GE(hits[i].primitive, 0) << "size " << size << ", ray " << i;
            const double weights[3] = {1 - double{hits[i].u} - hits[i].v, hits[i].u, hits[i].v};
            const Vec3d origin = vec3_at(rays, 2 * i);
            const Vec3d direction = vec3_at(rays, 2 * i + 1);
            Vec3d p{0, 0, 0};
            Vec3d end;
            for (std::size_t k = 0; k < 3; ++k) {
                end[k] = origin[k] + hits[i].t * direction[k];
                for (std::size_t c = 0; c < 3; ++c)
                    p[k] += weights[c] *
                            vec3_at(geometry.positions, 3 * std::size_t(hits[i].primitive) + c)[k];
            }
            const double offset = 0x1p-20 * std::max(1.0, 2 * length(p));
            farthest = std::max(farthest, std::abs(here.height(p)) / offset);
            end_farthest = std::max(
                end_farthest,
                std::abs(here.height(end)) / std::max(offset, 0x1p-19 * length(origin)));
        }
        EXPECT_LT(farthest, 0.25) << size;
        EXPECT_LT(end_farthest, 0.5) << size;
    }
}

}  // namespace
}  // namespace wavepath
