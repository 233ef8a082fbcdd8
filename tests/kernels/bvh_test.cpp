// WAVEPATH_HIT_RAYS: rays in all at the generated meshes, and at the bundled scenes; 10^6 and 10^7
// by default. WAVEPATH_INSIDE_RAYS: those from inside closed meshes, 10^6 by default; 10^9 takes an
// hour or two.
#include "build_paths.h"
#include "gltf/gltf_loader.h"
#include "prepare/bvh_builder.h"
#include "prepare/normalise.h"
#include "support/probe.h"
#include "support/ray_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

namespace wavepath {
namespace {

const Probe& probe() {
    static const Probe& instance = *new Probe({"geometry/bvh.cl"}, R"(
kernel void closest(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const float* r = rays + 8 * i;
    const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
    out[i] = closest_hit(make_tree(nodes, blocks), &ray, at_origin(), 0);
}

kernel void blocked(
    const uint count, global int* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const float* r = rays + 8 * i;
    const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
    out[i] = any_hit(make_tree(nodes, blocks), &ray, 0);
}
)");
    return instance;
}

std::vector<TestHit> closest(const Bvh& bvh, const std::vector<TestRay>& rays) {
    return probe().run<TestHit>(
        "closest", rays.size(), rays.size(), floats_of(rays), bvh.nodes, bvh.blocks);
}

std::vector<cl_int> any(const Bvh& bvh, const std::vector<TestRay>& rays) {
    return probe().run<cl_int>(
        "blocked", rays.size(), rays.size(), floats_of(rays), bvh.nodes, bvh.blocks);
}

// The rays of one kind at one mesh, of `kinds`, in batches.
template <typename Check>
void in_batches(const char* variable, std::size_t usual, std::size_t kinds, const Check& check) {
    const char* wanted = std::getenv(variable);
    const double total = wanted != nullptr ? std::atof(wanted) : static_cast<double>(scaled(usual));
    auto left = static_cast<std::size_t>(std::ceil(total / static_cast<double>(kinds)));
    for (unsigned seed = 1; left > 0; ++seed) {
        const std::size_t count = std::min<std::size_t>(left, 1U << 18U);
        std::mt19937 random(seed);
        check(count, random);
        if (testing::Test::HasFailure()) return;
        left -= count;
    }
}

constexpr std::array aims{Aim::random, Aim::axis_parallel, Aim::edge, Aim::vertex};

std::string text_of(const TestRay& ray) {
    char text[200];
    std::snprintf(
        text, sizeof text, "ray (%a %a %a) (%a %a %a)", ray.origin[0], ray.origin[1], ray.origin[2],
        ray.direction[0], ray.direction[1], ray.direction[2]);
    return text;
}

std::vector<TestMesh> all_meshes() {
    const std::size_t n = scaled(100);
    return {
        box_mesh(),
        room_mesh(),
        sphere_mesh(static_cast<unsigned>(8 + n), static_cast<unsigned>(8 + n)),
        height_field_mesh(static_cast<unsigned>(8 + 2 * n)),
        soup_mesh(200 * n),
        rods_mesh(static_cast<unsigned>(20 * n))};
}

// Exact but for what float cannot decide: RayOracle::agree.
void expect_hits_of_embree(const TestMesh& mesh, std::size_t rays_in_all, std::size_t meshes) {
    const Bvh bvh = build_bvh(mesh.positions);
    const RayOracle oracle(mesh);
    for (const Aim aim : aims)
        in_batches(
            "WAVEPATH_HIT_RAYS", rays_in_all, meshes * aims.size(),
            [&](std::size_t count, std::mt19937& random) {
                const std::vector<TestRay> rays = make_rays(mesh, aim, false, count, random);
                const std::vector<TestHit> ours = closest(bvh, rays);
                for (std::size_t i = 0; i < count; ++i) {
                    const TestHit theirs = oracle.closest(rays[i]);
                    ASSERT_TRUE(oracle.agree(rays[i], ours[i], theirs))
                        << mesh.name << ", aim " << static_cast<int>(aim) << ", "
                        << text_of(rays[i]) << ": triangle " << ours[i].primitive << " at "
                        << ours[i].t << ", Embree " << theirs.primitive << " at " << theirs.t;
                }
            });
}

TEST(Bvh, HitsAreEmbrees) {
    const std::vector<TestMesh> meshes = all_meshes();
    for (const TestMesh& mesh : meshes) expect_hits_of_embree(mesh, 1'000'000, meshes.size());
}

TEST(Bvh, HitsAreEmbreesInEveryScene) {
    std::vector<std::string> paths{WAVEPATH_TERRAIN};
    for (const auto& entry : std::filesystem::directory_iterator(WAVEPATH_SOURCE_DIR "/scenes"))
        if (const auto path = entry.path() / "scene.gltf"; std::filesystem::exists(path))
            paths.push_back(path.string());
    EXPECT_GE(paths.size(), 5U);
    for (const std::string& path : paths)
        expect_hits_of_embree(
            {path, normalise(load_gltf(path)).positions}, 10'000'000, paths.size());
}

// Exact: not one ray leaves a closed mesh unseen (ground truth 5.4).
TEST(Bvh, WatertightFromInside) {
    const std::vector<TestMesh> meshes{box_mesh(), sphere_mesh(12, 20), sphere_mesh(100, 100)};
    for (const TestMesh& mesh : meshes) {
        const Bvh bvh = build_bvh(mesh.positions);
        for (const Aim aim : aims)
            in_batches(
                "WAVEPATH_INSIDE_RAYS", 1'000'000, meshes.size() * aims.size(),
                [&](std::size_t count, std::mt19937& random) {
                    const std::vector<TestRay> rays = make_rays(mesh, aim, true, count, random);
                    const std::vector<TestHit> ours = closest(bvh, rays);
                    for (std::size_t i = 0; i < count; ++i)
                        ASSERT_GE(ours[i].primitive, 0)
                            << mesh.name << ", aim " << static_cast<int>(aim) << ", "
                            << text_of(rays[i]);
                });
    }
}

// A ray from 2^-20 off a triangle, where paths start, away from it: it goes through a triangle
// whose corners are moved by the rounding of the shear, a fifth of this, so it may never meet its
// own.
std::vector<TestRay> leaving_rays(const TestMesh& mesh, std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<float> gauss;
    std::vector<TestRay> rays(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* p = &mesh.positions[9 * (i % mesh.size())];
        const double u = std::sqrt(uniform(random));
        const double v = u * uniform(random);
        std::array<double, 3> e{};
        std::array<double, 3> f{};
        std::array<double, 3> n{};
        for (std::size_t k = 0; k < 3; ++k) {
            e[k] = static_cast<double>(p[3 + k]) - static_cast<double>(p[k]);
            f[k] = static_cast<double>(p[6 + k]) - static_cast<double>(p[k]);
        }
        double cosine = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            n[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
            rays[i].direction[k] = gauss(random);
            cosine += n[k] * static_cast<double>(rays[i].direction[k]);
        }
        const double offset = std::copysign(0x1p-20 / std::hypot(n[0], n[1], n[2]), cosine);
        for (std::size_t k = 0; k < 3; ++k)
            rays[i].origin[k] = static_cast<float>(
                static_cast<double>(p[k]) + (u - v) * e[k] + v * f[k] + offset * n[k]);
        rays[i].t_max = std::numeric_limits<float>::infinity();
    }
    return rays;
}

TEST(Bvh, NoRayThatLeavesASliverMeetsIt) {
    const TestMesh mesh = slivers_mesh(200);
    const Bvh bvh = build_bvh(mesh.positions);
    in_batches("WAVEPATH_HIT_RAYS", 1'000'000, 1, [&](std::size_t count, std::mt19937& random) {
        const std::vector<TestRay> rays = leaving_rays(mesh, count, random);
        const std::vector<TestHit> hits = closest(bvh, rays);
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_NE(hits[i].primitive, static_cast<int>(i % mesh.size())) << text_of(rays[i]);
    });
}

// Where triangles coincide the lowest id is hit, and another order of the triangles, which makes
// another tree, changes no distance.
TEST(Bvh, OrderOfTheTreeDecidesNothing) {
    for (const TestMesh& mesh : {room_mesh(), soup_mesh(5000)}) {
        const TestMesh repeated = repeated_mesh(mesh, 3);
        std::vector<std::size_t> order(repeated.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::mt19937 random(3);
        std::shuffle(order.begin(), order.end(), random);
        TestMesh shuffled{"shuffled", {}, false};
        for (const std::size_t i : order)
            shuffled.positions.insert(
                shuffled.positions.end(),
                repeated.positions.begin() + static_cast<std::ptrdiff_t>(9 * i),
                repeated.positions.begin() + static_cast<std::ptrdiff_t>(9 * i + 9));
        for (const Aim aim : aims) {
            const std::vector<TestRay> rays = make_rays(mesh, aim, false, scaled(20'000), random);
            const std::vector<TestHit> plain = closest(build_bvh(mesh.positions), rays);
            const std::vector<TestHit> copies = closest(build_bvh(repeated.positions), rays);
            const std::vector<TestHit> mixed = closest(build_bvh(shuffled.positions), rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_EQ(copies[i].primitive, plain[i].primitive) << text_of(rays[i]);
                ASSERT_EQ(copies[i].t, plain[i].t) << text_of(rays[i]);
                ASSERT_EQ(mixed[i].t, plain[i].t) << text_of(rays[i]);
            }
        }
    }
}

// Any hit is true exactly where a closest hit exists, up to t_max and no further.
TEST(Bvh, AnyHitAgreesWithClosestHit) {
    for (const TestMesh& mesh : {room_mesh(), soup_mesh(5000)}) {
        const Bvh bvh = build_bvh(mesh.positions);
        std::mt19937 random(4);
        for (const Aim aim : aims) {
            std::vector<TestRay> rays = make_rays(mesh, aim, false, scaled(30'000), random);
            const std::vector<TestHit> unbounded = closest(bvh, rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const float t = unbounded[i].t;
                const std::array<float, 5> ends{
                    0.5F * t, std::nextafter(t, 0.0F), t, std::nextafter(t, 10.0F * t), 0.0F};
                rays[i].t_max = ends[i % ends.size()];
            }
            const std::vector<TestHit> hits = closest(bvh, rays);
            const std::vector<cl_int> blocked = any(bvh, rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_EQ(blocked[i] != 0, hits[i].primitive >= 0)
                    << text_of(rays[i]) << " to " << rays[i].t_max;
                ASSERT_EQ(
                    blocked[i] != 0, unbounded[i].primitive >= 0 && unbounded[i].t < rays[i].t_max)
                    << text_of(rays[i]) << " to " << rays[i].t_max;
            }
        }
    }
}

// Rays that mean nothing end, and hit nothing but what is there.
TEST(Bvh, DegenerateRaysEnd) {
    const Bvh bvh = build_bvh(room_mesh().positions);
    const std::vector<TestRay> rays = degenerate_rays();
    for (const TestHit& hit : closest(bvh, rays)) {
        EXPECT_GE(hit.primitive, -1);
        EXPECT_LT(hit.primitive, 36);
    }
    EXPECT_EQ(any(bvh, rays).size(), rays.size());
    const Bvh empty = build_bvh({});
    for (const TestHit& hit : closest(empty, rays)) EXPECT_EQ(hit.primitive, -1);
}

}  // namespace
}  // namespace wavepath
