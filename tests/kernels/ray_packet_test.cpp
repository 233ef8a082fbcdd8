#include "prepare/bvh_builder.h"
#include "prepare/small_mesh.h"
#include "support/probe.h"
#include "support/ray_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace wavepath {
namespace {

constexpr std::size_t rays_per_item = 50;  // no multiple of a packet's

// A result has two hits a ray: the nearest, and the one behind it. Each kernel lets rays enter only
// if they have a t_max of at least 0, as a stage skips an idle slot. r[7]: where a ray starts,
// behind the triangle 4.
const Probe& probe() {
    static const Probe& instance = *new Probe(
        {"geometry/ray_packet.cl"},
        R"(
#define RAYS_PER_ITEM 50
kernel void closest(
    const uint count, global Hit* out, global const float* rays, global const SmallMesh* mesh) {
    uint i = (uint)get_global_id(0) * RAYS_PER_ITEM;
    const uint end = min(count, i + RAYS_PER_ITEM);
    RayPacket packet;
    packet_open(&packet);
    while (i < end) {
        for (; i < end && packet_has_room(&packet); ++i) {
            global const float* r = rays + 8 * i;
            const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
            if (r[6] < 0.0f) continue;
            packet_add(
                &packet, i, &ray, ray_start(r[7], 4));
        }
        PacketHits nearest, next;
        closest_of_packet(mesh, &packet, &nearest, &next);
        for (int k = 0; k < packet.count; ++k) {
            out[2 * packet.item[k]] = hit_of_lane(&nearest, k);
            out[2 * packet.item[k] + 1] = hit_of_lane(&next, k);
        }
        packet.count = 0;
    }
}

kernel void blocked(
    const uint count, global Hit* out, global const float* rays, global const SmallMesh* mesh) {
    uint i = (uint)get_global_id(0) * RAYS_PER_ITEM;
    const uint end = min(count, i + RAYS_PER_ITEM);
    RayPacket packet;
    packet_open(&packet);
    while (i < end) {
        for (; i < end && packet_has_room(&packet); ++i) {
            global const float* r = rays + 8 * i;
            const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
            if (r[6] < 0.0f) continue;
            packet_add(&packet, i, &ray, at_origin());
        }
        const uint blocked = any_of_packet(mesh, &packet);
        for (int k = 0; k < packet.count; ++k)
            out[2 * packet.item[k]].primitive = (int)(blocked >> k & 1u);
        packet.count = 0;
    }
}

kernel void alone(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const float* r = rays + 8 * i;
    const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
    if (r[6] < 0.0f) return;
    out[2 * i] = closest_hit(make_tree(nodes, blocks), &ray, ray_start(r[7], 4), 0);
    out[2 * i + 1] = out[2 * i];
    if (out[2 * i].primitive >= 0)
        out[2 * i + 1] = closest_hit(make_tree(nodes, blocks), &ray, ray_start(out[2 * i].t, out[2 * i].primitive), 0);
}

kernel void blocked_alone(
    const uint count, global Hit* out, global const float* rays, global const BvhNode* nodes,
    global const TriangleBlock* blocks) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const float* r = rays + 8 * i;
    const Ray ray = make_ray(vec3(r[0], r[1], r[2]), vec3(r[3], r[4], r[5]), r[6]);
    if (r[6] < 0.0f) return;
    out[2 * i].primitive =
        any_hit(make_tree(nodes, blocks), &ray, 0);
}
)",
        "#define HAS_ALPHA 0\n");
    return instance;
}

// Twelve triangles, each four times: at equal distance the lowest id has to win.
TestMesh fourfold_box() {
    TestMesh mesh = box_mesh();
    const std::vector<float> once = mesh.positions;
    for (int copy = 1; copy < 4; ++copy)
        mesh.positions.insert(mesh.positions.end(), once.begin(), once.end());
    return mesh;
}

// Exact: a packet gives the bits of lone rays, every ray once, whatever its neighbours are.
TEST(RayPacket, TracesAsRaysAlone) {
    std::mt19937 random(7);
    for (const TestMesh& mesh :
         {box_mesh(), room_mesh(), fourfold_box(), rods_mesh(4), soup_mesh(16)}) {
        const Bvh bvh = build_bvh(mesh.positions);
        const std::optional<SmallMesh> small = small_mesh(mesh.positions);
        ASSERT_TRUE(small) << mesh.name << " has " << mesh.size() << " triangles";
        const std::vector<SmallMesh> packed{*small};
        for (const Aim aim : {Aim::random, Aim::axis_parallel, Aim::edge, Aim::vertex}) {
            std::vector<TestRay> rays = make_rays(mesh, aim, false, 13 + scaled(30'000), random);
            const std::vector<TestRay> degenerate = degenerate_rays();
            rays.insert(rays.begin() + 20, degenerate.begin(), degenerate.end());
            for (std::size_t i = 0; i < rays.size(); i += 3)
                rays[i].t_max = std::array{-1.0F, 0.0F, 0.7F, 1e-30F, 1e30F}[i % 5];
            for (std::size_t i = 0; i < rays.size(); i += 4) rays[i].padding = 0.8F;
            const std::size_t n = rays.size();
            const auto alone =
                probe().run<TestHit>("alone", n, 2 * n, floats_of(rays), bvh.nodes, bvh.blocks);
            // again, behind exactly the triangle 4 where that was met first
            for (std::size_t i = 0; i < n; ++i)
                if (alone[2 * i].primitive == 4) rays[i].padding = alone[2 * i].t;
            const auto expected =
                probe().run<TestHit>("alone", n, 2 * n, floats_of(rays), bvh.nodes, bvh.blocks);
            const auto closest = probe().run<TestHit>("closest", n, 2 * n, floats_of(rays), packed);
            const auto blocked = probe().run<TestHit>("blocked", n, 2 * n, floats_of(rays), packed);
            const auto blocked_alone = probe().run<TestHit>(
                "blocked_alone", n, 2 * n, floats_of(rays), bvh.nodes, bvh.blocks);
            for (std::size_t i = 0; i < 2 * n; ++i) {
                ASSERT_TRUE(same_bits(closest[i], expected[i]))
                    << mesh.name << ", ray " << i / 2 << ", hit " << i % 2 << ": "
                    << closest[i].primitive << " at " << closest[i].t << ", alone "
                    << expected[i].primitive << " at " << expected[i].t;
                ASSERT_EQ(blocked[i].primitive, blocked_alone[i].primitive)
                    << mesh.name << ", ray " << i / 2;
            }
        }
    }
}

TEST(RayPacket, FewRaysAndNone) {
    const TestMesh room = room_mesh();
    const std::vector<SmallMesh> packed{*small_mesh(room.positions)};
    std::mt19937 random(6);
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{7}, std::size_t{8}, std::size_t{9}, rays_per_item,
          rays_per_item + 1}) {
        std::vector<TestRay> rays = make_rays(room, Aim::random, true, count, random);
        const auto hits =
            probe().run<TestHit>("closest", count, 2 * count, floats_of(rays), packed);
        for (std::size_t i = 0; i < count; ++i) EXPECT_GE(hits[2 * i].primitive, 0) << count;
        for (TestRay& ray : rays) ray.t_max = -1;  // none enters: every result stays as it was
        for (const TestHit& hit :
             probe().run<TestHit>("closest", count, 2 * count, floats_of(rays), packed))
            EXPECT_EQ(std::bit_cast<int>(hit.t), 0) << count;
    }
}

}  // namespace
}  // namespace wavepath
