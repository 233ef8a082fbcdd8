// Finds the closest triangle along every ray. A ray outside all media passes boundaries without a
// tint at once: there is nothing to decide at them. One that would leave all media there and meet
// nothing behind is told so here, which saves it a round of all stages.
//
// reads: rays, hits, path_media, ids, nodes, blocks, mesh, triangles, materials, textures (holes)
//
// writes: hits, path_media
//
// One work-item for RAYS_PER_ITEM slots.

#include "geometry/path_state.cl"
#include "geometry/ray_packet.cl"
#include "geometry/ray_stream.cl"
#include "media/medium_stack.cl"
#include "sampling/dimensions.cl"
#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/scene.h"

// Behind the boundary that the ray passed last.
INLINE RayStart load_start(global const float* path_media, const size_t stride, const size_t slot) {
    if (!HAS_PASSAGES) return at_origin();
    return ray_start(
        max(PLANE(path_media, MEDIUM_T)[slot], 0.0f),
        as_int(PLANE(path_media, MEDIUM_PRIMITIVE)[slot]));
}

// Whether the ray passes the boundary of this medium and no more happens to it; 0: no.
INLINE uint clear_medium(
    global const float* triangles, global const DeviceMaterial* materials, const int primitive) {
    if (HAS_VERTEX_COLORS || primitive < 0) return 0;
    global const DeviceMaterial* material =
        materials + as_int(triangles[(size_t)TRIANGLE_FLOATS * primitive + TRIANGLE_MATERIAL]);
    return material->boundary == BOUNDARY_CLEAR ? material->medium : 0;
}

INLINE int has_ray(global const float* hits, const size_t stride, const size_t slot) {
    if (hit_of(hits, stride, slot) == HIT_IDLE) return 0;
    return !is_traced(hits, stride, slot);
}

// What lies behind a hit: `next`, or what a ray finds where that is not known, 0.
INLINE Hit
hit_behind(const Hit* hit, const Hit* next, const Tree tree, const Ray* ray, const Cover* cover) {
    if (next) return *next;
    return closest_hit(tree, ray, ray_start(hit->t, hit->primitive), holes_in(cover));
}

// Stores the hit, or what lies behind the boundaries that the ray passes at once. `next`: what lies
// behind the hit, or 0 if that is not known.
INLINE void pass_clear_boundaries(
    const size_t stride,
    const size_t slot,
    const Tree tree,
    global const DeviceMaterial* materials,
    const Cover* cover,
    global const float* rays,
    Hit hit,
    const Hit* next,
    global float* path_media,
    global float* hits) {
    const Ray ray = load_ray(rays, stride, slot);
    global const float* triangles = cover->triangles;
    uint stack = HAS_MEDIA ? as_uint(PLANE(path_media, MEDIUM_STACK)[slot]) : 0;
    while (HAS_MEDIA) {
        const uint medium = clear_medium(triangles, materials, hit.primitive);
        if (medium == 0) break;
        global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * hit.primitive;
        const uint crossed = cross_boundary(stack, medium, triangle, ray.direction);
        // Two calls, since LLVM 18 as PoCL 6.0 runs it gives up on one that both cases share.
        if (stack != 0) {
            if (crossed != 0 || HAS_SPLITS) break;
            const Hit behind = hit_behind(&hit, next, tree, &ray, cover);
            if (behind.primitive < 0) hit.primitive = HIT_LEAVING;
            break;
        }
        const Hit behind = hit_behind(&hit, next, tree, &ray, cover);
        next = 0;
        go_on_behind(
            path_media, stride, slot, stack, crossed, hit.t, hit.primitive,
            touching_distance(triangle, madd3(ray.origin, ray.direction, hit.t), ray.direction));
        stack = crossed;
        hit = behind;
    }
    store_hit(hits, stride, slot, &hit);
}

INLINE void intersect_packets(
    const size_t stride,
    uint slot,
    const uint end,
    const Tree tree,
    global const SmallMesh* mesh,
    global const DeviceMaterial* materials,
    const Cover* cover,
    global const float* rays,
    global float* path_media,
    global float* hits) {
    RayPacket packet;
    packet_open(&packet);
    while (slot < end) {
        for (; slot < end && packet_has_room(&packet); ++slot) {
            if (!has_ray(hits, stride, slot)) continue;
            const Ray ray = load_ray(rays, stride, slot);
            packet_add(&packet, slot, &ray, load_start(path_media, stride, slot));
        }
        if (packet.count == 0) break;
        PacketHits nearest, behind;
        closest_of_packet(mesh, &packet, &nearest, &behind);
        for (int k = 0; k < packet.count; ++k) {
            const Hit next = hit_of_lane(&behind, k);
            pass_clear_boundaries(
                stride, packet.item[k], tree, materials, cover, rays, hit_of_lane(&nearest, k),
                HAS_MATCHED_MEDIA ? &next : 0, path_media, hits);
        }
        packet.count = 0;
    }
}

INLINE void intersect_stream(
    const size_t stride,
    uint slot,
    const uint end,
    const Tree tree,
    const Cover* cover,
    global const float* rays,
    global const float* path_media,
    global const uint* ids,
    global float* hits) {
    RayStream stream;
    stream_open(&stream);
    do {
        for (; slot < end && stream_has_room(&stream); ++slot) {
            if (!has_ray(hits, stride, slot)) continue;
            const Ray ray = load_ray(rays, stride, slot);
            stream_add(
                &stream, slot, &ray, load_start(path_media, stride, slot),
                HAS_ALPHA ? cover_key(ids, stride, slot) : 0);
        }
        stream_step(&stream, tree, cover, 0);
        for (int k = 0; k < stream.ended; ++k) {
            const StreamRay* ended = stream_ended(&stream, k);
            store_hit(hits, stride, ended->item, &ended->hit);
        }
    } while (slot < end || stream_busy(&stream));
}

kernel void intersect(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const BvhNode* restrict nodes,
    global const TriangleBlock* restrict blocks,
    global const SmallMesh* restrict mesh,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    TEXTURE_PARAMETERS,
    global const float* restrict rays,
    global float* restrict path_media,
    global const uint* restrict ids,
    global float* restrict hits) {
    const size_t stride = settings->stride;
    const uint slot = (uint)get_global_id(0) * RAYS_PER_ITEM;
    if (slot >= slots) return;
    const uint end = min(slots, slot + RAYS_PER_ITEM);
    const Cover cover =
        ray_cover(TEXTURES, triangles, HAS_ALPHA ? cover_key(ids, stride, slot) : 0);
    const Tree tree = make_tree(nodes, blocks);
    if (RAY_PACKETS) {
        intersect_packets(stride, slot, end, tree, mesh, materials, &cover, rays, path_media, hits);
    } else if (RAYS_PER_ITEM > 1) {
        intersect_stream(stride, slot, end, tree, &cover, rays, path_media, ids, hits);
    } else if (has_ray(hits, stride, slot)) {
        const Ray ray = load_ray(rays, stride, slot);
        const Hit hit =
            closest_hit(tree, &ray, load_start(path_media, stride, slot), holes_in(&cover));
        pass_clear_boundaries(
            stride, slot, tree, materials, &cover, rays, hit, 0, path_media, hits);
    }
}
