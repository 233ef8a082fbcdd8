// Looks behind every dielectric face and thin wall that a ray met for what touches it: what lies
// within RAY_OFFSET is one interface with it, since the ray that leaves starts beyond. An opaque
// surface there is hit in its place, and glass in the place of a thin wall; boundaries are crossed
// with it.
//
// reads: rays, hits, media, ids, scene, textures
//
// writes: hits, media
//
// One work-item a slot. Thin walls there are not seen.

#include "geometry/bvh.cl"
#include "media/boundary.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

kernel void find_contacts(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const BvhNode* restrict nodes,
    global const TriangleBlock* restrict blocks,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    TEXTURE_PARAMETERS,
    global const float* restrict rays,
    global float* restrict path_media,
    global const uint* restrict ids,
    global float* restrict hits) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int face = as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
    const float face_t = PLANE(hits, HIT_T)[slot];
    if (face < 0) return;
    if (HAS_SPLITS && face_t < 0.0f) return;
    global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * face;
    global const DeviceMaterial* material = materials + as_int(triangle[TRIANGLE_MATERIAL]);
    int is_wall = (material->boundary == BOUNDARY_OPAQUE) & (material->transmission > 0.0f);
    if (material->boundary != BOUNDARY_DIELECTRIC && !is_wall) return;
    const Vec3 origin = load3(PLANE(rays, RAY_ORIGIN_X), stride, slot);
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const Cover cover =
        ray_cover(TEXTURES, triangles, HAS_ALPHA ? cover_key(ids, stride, slot) : 0);
    float end = face_t + touching_distance(triangle, direction);
    uint stack = HAS_MEDIA ? as_uint(PLANE(path_media, MEDIUM_STACK)[slot]) : 0;
    Vec3 tint = vec3(1.0f, 1.0f, 1.0f);
    if (!is_wall) {
        const uint crossed = cross_boundary(stack, material->medium, triangle, direction);
        tint = scale3(tint, weight_of_crossing(stack, crossed, material->medium));
        stack = crossed;
    }
    RayStart start = ray_start(face_t, face);
    for (;;) {
        const Hit hit = closest_hit(
            nodes, blocks, origin.x, origin.y, origin.z, direction.x, direction.y, direction.z, end,
            start, holes_in(&cover));
        if (hit.primitive < 0) break;
        start = ray_start(hit.t, hit.primitive);
        triangle = triangles + (size_t)TRIANGLE_FLOATS * hit.primitive;
        material = materials + as_int(triangle[TRIANGLE_MATERIAL]);
        const int is_opaque = material->boundary == BOUNDARY_OPAQUE;
        if (is_opaque && material->transmission > 0.0f) continue;
        const int replaces = is_opaque | (is_wall & (material->boundary == BOUNDARY_DIELECTRIC));
        if (replaces) {
            PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(hit.primitive);
            PLANE(hits, HIT_T)[slot] = hit.t;
            PLANE(hits, HIT_U)[slot] = hit.u;
            PLANE(hits, HIT_V)[slot] = hit.v;
            if (is_opaque) return;
            is_wall = 0;
            end = hit.t + touching_distance(triangle, direction);
        }
        const uint crossed = cross_boundary(stack, material->medium, triangle, direction);
        tint = scale3(tint, weight_of_crossing(stack, crossed, material->medium));
        if (!replaces) tint = mul3(tint, tint_of_boundary(&cover, materials, &hit));
        stack = crossed;
    }
    if (!HAS_MEDIA) return;
    PLANE(path_media, CONTACT_MEDIA)[slot] = as_float(stack);
    store3(PLANE(path_media, CONTACT_R), stride, slot, tint);
}
