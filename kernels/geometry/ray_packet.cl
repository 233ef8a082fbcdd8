// Eight rays against every triangle of a small scene, without a tree: for CPUs, where a tree of a
// few dozen triangles costs a ray more in branches that no predictor foresees than all of its
// triangles cost without one (docs/design/intersect.md has the measurements). The bits are
// those of closest_hit and any_hit. After the packets of [Wald 2001], which walk a tree together.
//
//     RayPacket packet;
//     packet_open(&packet);
//     while (rays are left) {
//         while (rays are left && packet_has_room(&packet)) packet_add(&packet, item, ...);
//         closest_of_packet(mesh, &packet, &nearest, &next);
//         for (int k = 0; k < packet.count; ++k) use packet.item[k], hit_of_lane(&nearest, k)
//         packet.count = 0;
//     }
#pragma once

#include "geometry/bvh.cl"
#include "sampling/vector.cl"
#include "shared/small_mesh.h"

#ifndef RAY_PACKETS
#define RAY_PACKETS 0  // 1: the scene is a small mesh without holes
#endif
#define PACKET_RAYS 8

typedef struct {
    float ox[PACKET_RAYS], oy[PACKET_RAYS], oz[PACKET_RAYS];
    float dx[PACKET_RAYS], dy[PACKET_RAYS], dz[PACKET_RAYS];
    float t_max[PACKET_RAYS];
    float start_t[PACKET_RAYS];
    int start_primitive[PACKET_RAYS];
    uint item[PACKET_RAYS];  // the caller's name for the ray
    int count;
} RayPacket;

typedef struct {
    float8 t, u, v;
    int8 primitive;  // -1: none
} PacketHits;

// Corners of the mesh as the rays of a packet see them: moved and sheared as shear_ray and
// intersect_block do it.
typedef struct {
    float8 x[SMALL_MESH_CORNERS];
    float8 y[SMALL_MESH_CORNERS];
    float8 z[SMALL_MESH_CORNERS];
    float8 sz;
} ShearedMesh;

// Lanes that hold no ray are computed with the others and looked at by nobody.
INLINE void packet_open(RayPacket* packet) {
    for (int k = 0; k < PACKET_RAYS; ++k) {
        packet->ox[k] = packet->oy[k] = packet->oz[k] = 0.0f;
        packet->dx[k] = packet->dy[k] = packet->dz[k] = 0.0f;
        packet->t_max[k] = -1.0f;
        packet->start_t[k] = 0.0f;
        packet->start_primitive[k] = -1;
    }
    packet->count = 0;
}

INLINE int packet_has_room(const RayPacket* packet) {
    return packet->count < PACKET_RAYS;
}

INLINE void packet_add(RayPacket* packet, const uint item, const Ray* ray, const RayStart start) {
    const int k = packet->count;
    packet->ox[k] = ray->origin.x;
    packet->oy[k] = ray->origin.y;
    packet->oz[k] = ray->origin.z;
    packet->dx[k] = ray->direction.x;
    packet->dy[k] = ray->direction.y;
    packet->dz[k] = ray->direction.z;
    packet->t_max[k] = end_of_ray(ray);
    packet->start_t[k] = start.t;
    packet->start_primitive[k] = start.primitive;
    packet->item[k] = item;
    packet->count = k + 1;
}

// By the rays' largest part of the direction: z's, y's, or x's.
INLINE float8
largest(const float8 z, const float8 y, const float8 x, const int8 z_wins, const int8 y_wins) {
    return select(select(x, y, y_wins), z, z_wins);
}

INLINE void shear_mesh(
    global const SmallMesh* mesh, const RayPacket* rays, ShearedMesh* restrict sheared) {
    const float8 dx = vload8(0, rays->dx);
    const float8 dy = vload8(0, rays->dy);
    const float8 dz = vload8(0, rays->dz);
    const int8 z_wins = fabs(dz) >= max(fabs(dx), fabs(dy));
    const int8 y_wins = fabs(dy) >= fabs(dx);
    const float8 sz = 1.0f / largest(dz, dy, dx, z_wins, y_wins);
    const float8 sx = -sz * largest(dx, dz, dy, z_wins, y_wins);
    const float8 sy = -sz * largest(dy, dx, dz, z_wins, y_wins);
    const float8 along_x = vload8(0, rays->ox);
    const float8 along_y = vload8(0, rays->oy);
    const float8 along_z = vload8(0, rays->oz);
    const float8 ox = largest(along_x, along_z, along_y, z_wins, y_wins);
    const float8 oy = largest(along_y, along_x, along_z, z_wins, y_wins);
    const float8 oz = largest(along_z, along_y, along_x, z_wins, y_wins);
    sheared->sz = sz;
    const uint count = mesh->corner_count;
    for (uint k = 0; k < count; ++k) {
        const float8 x = mesh->corners[0][k];
        const float8 y = mesh->corners[1][k];
        const float8 z = mesh->corners[2][k];
        const float8 depth = largest(z, y, x, z_wins, y_wins) - oz;
        sheared->x[k] = fma(depth, sx, largest(x, z, y, z_wins, y_wins) - ox);
        sheared->y[k] = fma(depth, sy, largest(y, x, z, z_wins, y_wins) - oy);
        sheared->z[k] = depth;
    }
}

INLINE Corners sheared_corner(const ShearedMesh* mesh, const uint k) {
    Corners corner;
    corner.x = mesh->x[k];
    corner.y = mesh->y[k];
    corner.z = mesh->z[k];
    return corner;
}

// Rays that hit triangle k of the mesh with t > 0 (-1), and where.
INLINE int8 intersect_lanes(
    global const SmallMesh* mesh,
    const ShearedMesh* sheared,
    const uint k,
    float8* t,
    float8* u,
    float8* v) {
    return intersect_sheared(
        sheared_corner(sheared, mesh->triangles[k][0]),
        sheared_corner(sheared, mesh->triangles[k][1]),
        sheared_corner(sheared, mesh->triangles[k][2]), sheared->sz, t, u, v);
}

// The closest triangle behind the start and before t_max of every ray; with HAS_MATCHED_MEDIA,
// where rays go on behind boundaries, also the one behind it. Ids ascend and a later hit has to be
// nearer, so that at equal distance the lowest stays. Not inlined, as closest_hit.
void closest_of_packet(
    global const SmallMesh* mesh,
    const RayPacket* rays,
    PacketHits* restrict nearest,
    PacketHits* restrict next) {
    ShearedMesh sheared;
    shear_mesh(mesh, rays, &sheared);
    const float8 none = 0.0f;
    PacketHits first = {vload8(0, rays->t_max), none, none, (int8)(-1)};
    const float8 start_t = vload8(0, rays->start_t);
    const int8 start_primitive = vload8(0, rays->start_primitive);
    PacketHits second = first;
    const uint count = mesh->triangle_count;
    for (uint k = 0; k < count; ++k) {
        float8 t, u, v;
        int8 hit = intersect_lanes(mesh, &sheared, k, &t, &u, &v);
        const int8 id = (int8)((int)k);
        if (STARTS_BEHIND) hit &= (t > start_t) | ((t == start_t) & (id > start_primitive));
        const int8 nearer = hit & (t < first.t);
        if (HAS_MATCHED_MEDIA) {
            const int8 near = hit & (t < second.t);
            second.t = select(second.t, select(t, first.t, nearer), near);
            second.u = select(second.u, select(u, first.u, nearer), near);
            second.v = select(second.v, select(v, first.v, nearer), near);
            second.primitive = select(second.primitive, select(id, first.primitive, nearer), near);
        }
        first.t = select(first.t, t, nearer);
        first.u = select(first.u, u, nearer);
        first.v = select(first.v, v, nearer);
        first.primitive = select(first.primitive, id, nearer);
    }
    *nearest = first;
    *next = second;
}

// Rays that meet a triangle before t_max: bit k is that of ray k. Not inlined, as any_hit.
uint any_of_packet(global const SmallMesh* mesh, const RayPacket* rays) {
    ShearedMesh sheared;
    shear_mesh(mesh, rays, &sheared);
    const float8 end = vload8(0, rays->t_max);
    int8 blocked = 0;
    const uint count = mesh->triangle_count;
    for (uint k = 0; k < count; ++k) {
        float8 t, u, v;
        const int8 hit = intersect_lanes(mesh, &sheared, k, &t, &u, &v);
        blocked |= hit & (t < end);
    }
    return lane_mask(blocked);
}

INLINE Hit hit_of_lane(const PacketHits* hits, const int lane) {
    Hit hit;
    hit.t = ((const float*)&hits->t)[lane];
    hit.u = ((const float*)&hits->u)[lane];
    hit.v = ((const float*)&hits->v)[lane];
    hit.primitive = ((const int*)&hits->primitive)[lane];
    return hit;
}
