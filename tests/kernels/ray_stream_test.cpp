#include "prepare/bvh_builder.h"
#include "support/probe.h"
#include "support/ray_oracle.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace wavepath {
namespace {

constexpr std::size_t rays_per_item = 50;  // more than a stream holds, and no multiple of it

// Each kernel lets rays enter only if they have a t_max of at least 0, as a stage skips an idle
// slot.
const Probe& probe() {
    static const Probe& instance = *new Probe(
        {"geometry/ray_stream.cl"},
        R"(
void trace(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks, const int any) {
    uint i = (uint)get_global_id(0) * RAYS_PER_ITEM;
    if (i >= count) return;
    const uint end = min(count, i + RAYS_PER_ITEM);
    const Cover cover = full_cover();
    RayStream stream;
    stream_open(&stream);
    do {
        for (; i < end && stream_has_room(&stream); ++i) {
            global const float* r = rays + 8 * i;
            const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
            if (r[6] < 0.0f) continue;
            stream_add(&stream, i, &ray, at_origin(), 0);
        }
        stream_step(&stream, make_tree(nodes, blocks), &cover, any);
        for (int k = 0; k < stream.ended; ++k) out[stream_ended(&stream, k)->item] = stream_ended(&stream, k)->hit;
    } while (i < end || stream_busy(&stream));
}

kernel void closest(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    trace(count, out, rays, nodes, blocks, 0);
}

kernel void blocked(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    trace(count, out, rays, nodes, blocks, 1);
}

kernel void alone(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const float* r = rays + 8 * i;
    const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
    if (r[6] < 0.0f) return;
    out[i] = closest_hit(make_tree(nodes, blocks), &ray, at_origin(), 0);
}
)",
        "#define RAYS_PER_ITEM 50\n");
    return instance;
}

std::vector<TestHit> run(const char* kernel, const Bvh& bvh, const std::vector<TestRay>& rays) {
    return probe().run<TestHit>(
        kernel, rays.size(), rays.size(), floats_of(rays), bvh.nodes, bvh.blocks);
}

// Exact: the stream gives the bits of the lone ray, every ray once, whatever its neighbours are.
TEST(RayStream, TracesAsRaysAlone) {
    const std::size_t n = scaled(100);
    std::mt19937 random(5);
    for (const TestMesh& mesh :
         {box_mesh(), room_mesh(), sphere_mesh(60, 60), sphere_mesh(300, 300), soup_mesh(100 * n),
          rods_mesh(static_cast<unsigned>(10 * n))}) {
        const Bvh bvh = build_bvh(mesh.positions);
        for (const Aim aim : {Aim::random, Aim::axis_parallel, Aim::edge, Aim::vertex}) {
            std::vector<TestRay> rays = make_rays(mesh, aim, false, 13 + scaled(30'000), random);
            for (std::size_t i = 0; i < rays.size(); i += 3)
                rays[i].t_max = std::array{-1.0F, 0.0F, 0.7F, 1e-30F, 1e30F}[i % 5];
            const std::vector<TestHit> alone = run("alone", bvh, rays);
            const std::vector<TestHit> closest = run("closest", bvh, rays);
            const std::vector<TestHit> any = run("blocked", bvh, rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_TRUE(same_bits(closest[i], alone[i]))
                    << mesh.name << ", ray " << i << ": " << closest[i].primitive << " at "
                    << closest[i].t << ", alone " << alone[i].primitive << " at " << alone[i].t;
                ASSERT_EQ(any[i].primitive >= 0, alone[i].primitive >= 0)
                    << mesh.name << ", ray " << i;
            }
        }
    }
}

TEST(RayStream, DegenerateRaysEnd) {
    const Bvh bvh = build_bvh(room_mesh().positions);
    const std::vector<TestRay> rays = degenerate_rays();
    for (const char* kernel : {"closest", "blocked"})
        for (const TestHit& hit : run(kernel, bvh, rays)) {
            EXPECT_GE(hit.primitive, -1);
            EXPECT_LT(hit.primitive, 36);
        }
}

TEST(RayStream, FewRaysAndNone) {
    const Bvh bvh = build_bvh(room_mesh().positions);
    std::mt19937 random(6);
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{15}, std::size_t{16}, std::size_t{17}, rays_per_item,
          rays_per_item + 1}) {
        std::vector<TestRay> rays = make_rays(room_mesh(), Aim::random, true, count, random);
        for (const TestHit& hit : run("closest", bvh, rays)) EXPECT_GE(hit.primitive, 0) << count;
        for (TestRay& ray : rays) ray.t_max = -1;  // none enters: every result stays as it was
        for (const TestHit& hit : run("closest", bvh, rays))
            EXPECT_EQ(std::bit_cast<int>(hit.t), 0) << count;
    }
}

}  // namespace
}  // namespace wavepath
