// Traces the pending connections and adds what arrives.
//
// reads: shadows, ids, radiances, nodes, blocks, mesh, triangles, textures (holes)
//
// writes: radiances, fates
//
// One work-item for RAYS_PER_ITEM slots.

#include "geometry/ray_packet.cl"
#include "geometry/ray_stream.cl"
#include "lights/connection.cl"
#include "sampling/dimensions.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"

INLINE void add_connection(
    global const float* shadows, global float* radiances, const size_t stride, const size_t slot) {
    for (int k = 0; k < 3; ++k)
        PLANE(radiances, RADIANCE_R + k)[slot] += PLANE(shadows, SHADOW_R + k)[slot];
}

INLINE void connect_packets(
    const size_t stride,
    uint slot,
    const uint end,
    global const SmallMesh* mesh,
    global const float* shadows,
    global float* radiances,
    global uchar* fates) {
    RayPacket packet;
    packet_open(&packet);
    while (slot < end) {
        for (; slot < end && packet_has_room(&packet); ++slot) {
            const float t_max = open_connection(shadows, fates, stride, slot);
            if (t_max <= 0.0f) continue;
            const Ray ray = load_shadow_ray(shadows, stride, slot, t_max);
            packet_add(&packet, slot, &ray, at_origin());
        }
        if (packet.count == 0) break;
        const uint blocked = any_of_packet(mesh, &packet);
        for (int k = 0; k < packet.count; ++k)
            if ((blocked >> k & 1u) == 0)
                add_connection(shadows, radiances, stride, packet.item[k]);
        packet.count = 0;
    }
}

INLINE void connect_stream(
    const size_t stride,
    uint slot,
    const uint end,
    const Tree tree,
    const Cover* cover,
    global const float* shadows,
    global const uint* ids,
    global float* radiances,
    global uchar* fates) {
    RayStream stream;
    stream_open(&stream);
    do {
        for (; slot < end && stream_has_room(&stream); ++slot) {
            const float t_max = open_connection(shadows, fates, stride, slot);
            if (t_max <= 0.0f) continue;
            const Ray ray = load_shadow_ray(shadows, stride, slot, t_max);
            stream_add(
                &stream, slot, &ray, at_origin(),
                HAS_ALPHA ? shadow_cover_key(ids, stride, slot) : 0);
        }
        stream_step(&stream, tree, cover, 1);
        for (int k = 0; k < stream.ended; ++k) {
            const StreamRay* ended = stream_ended(&stream, k);
            if (ended->hit.primitive < 0) add_connection(shadows, radiances, stride, ended->item);
        }
    } while (slot < end || stream_busy(&stream));
}

INLINE void connect_alone(
    const size_t stride,
    const uint slot,
    const Tree tree,
    const Cover* cover,
    global const float* shadows,
    global float* radiances,
    global uchar* fates) {
    const float t_max = open_connection(shadows, fates, stride, slot);
    if (t_max <= 0.0f) return;
    const Ray ray = load_shadow_ray(shadows, stride, slot, t_max);
    if (!any_hit(tree, &ray, holes_in(cover))) add_connection(shadows, radiances, stride, slot);
}

kernel void occlusion(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const BvhNode* restrict nodes,
    global const TriangleBlock* restrict blocks,
    global const SmallMesh* restrict mesh,
    global const float* restrict triangles,
    TEXTURE_PARAMETERS,
    global const float* restrict shadows,
    global const uint* restrict ids,
    global float* restrict radiances,
    global uchar* restrict fates) {
    const size_t stride = settings->stride;
    const uint slot = (uint)get_global_id(0) * RAYS_PER_ITEM;
    if (slot >= slots) return;
    const uint end = min(slots, slot + RAYS_PER_ITEM);
    const Cover cover =
        ray_cover(TEXTURES, triangles, HAS_ALPHA ? shadow_cover_key(ids, stride, slot) : 0);
    const Tree tree = make_tree(nodes, blocks);
    if (RAY_PACKETS)
        connect_packets(stride, slot, end, mesh, shadows, radiances, fates);
    else if (RAYS_PER_ITEM > 1)
        connect_stream(stride, slot, end, tree, &cover, shadows, ids, radiances, fates);
    else
        connect_alone(stride, slot, tree, &cover, shadows, radiances, fates);
}
