// Looks behind every dielectric face and thin wall that a ray met for what touches it: what lies
// within ray_offset is one interface with it, since the ray that leaves starts beyond. An opaque
// surface there is hit in its place, and glass in the place of a thin wall; boundaries are crossed
// with it. Of a boundary that transmits in part the opaque share counts as an opaque surface. Of
// opaque surfaces that touch one that emits towards the ray is hit (geometry/shown_face.cl).
//
// reads: rays, hits, path_media, ids, nodes, blocks, triangles, materials, textures (holes, tints)
//
// writes: hits, path_media
//
// One work-item a slot. Thin walls there are not seen.

#include "geometry/path_state.cl"
#include "geometry/shown_face.cl"
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
    Hit shown;
    shown.primitive = hit_of(hits, stride, slot);
    shown.t = PLANE(hits, HIT_T)[slot];
    shown.u = PLANE(hits, HIT_U)[slot];
    shown.v = PLANE(hits, HIT_V)[slot];
    if (!at_surface(shown.primitive)) return;
    if (is_traced(hits, stride, slot)) return;
    global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * shown.primitive;
    global const DeviceMaterial* material = materials + as_int(triangle[TRIANGLE_MATERIAL]);
    int is_wall = (material->boundary == BOUNDARY_OPAQUE) & (material->transmission > 0.0f);
    int is_opaque = (material->boundary == BOUNDARY_OPAQUE) & !is_wall;
    if (material->boundary >= BOUNDARY_INDEX_MATCHED) return;
    if (is_opaque) {
        if (!HAS_LAMP_CONTACTS) return;
        if (as_uint(triangle[TRIANGLE_LIGHT]) == NO_LIGHT) return;
    }
    const Tree tree = make_tree(nodes, blocks);
    Ray ray = load_ray(rays, stride, slot);
    const Vec3 direction = ray.direction;
    const Cover cover =
        ray_cover(TEXTURES, triangles, HAS_ALPHA ? cover_key(ids, stride, slot) : 0);
    const uint key = PARTIAL_BOUNDARIES ? share_key(ids, rays, stride, slot) : 0;
    if (material->boundary == BOUNDARY_DIELECTRIC)
        is_opaque = !boundary_is_met(&cover, materials, key, &shown);
    if (!HAS_LAMP_CONTACTS && is_opaque) return;
    ray.t_max =
        shown.t + touching_distance(triangle, madd3(ray.origin, direction, shown.t), direction);
    uint stack = HAS_MEDIA ? as_uint(PLANE(path_media, MEDIUM_STACK)[slot]) : 0;
    Vec3 tint = vec3(1.0f, 1.0f, 1.0f);
    if (material->boundary == BOUNDARY_DIELECTRIC && !is_opaque) {
        const uint crossed = cross_boundary(stack, material->medium, triangle, direction);
        tint = scale3(tint, weight_of_crossing(stack, crossed, material->medium));
        stack = crossed;
    }
    RayStart start = ray_start(shown.t, shown.primitive);
    while (!is_opaque) {
        const Hit hit = closest_hit(tree, &ray, start, holes_in(&cover));
        if (hit.primitive < 0) break;
        start = ray_start(hit.t, hit.primitive);
        triangle = triangles + (size_t)TRIANGLE_FLOATS * hit.primitive;
        material = materials + as_int(triangle[TRIANGLE_MATERIAL]);
        if (material->boundary == BOUNDARY_OPAQUE && material->transmission > 0.0f) continue;
        is_opaque =
            material->boundary == BOUNDARY_OPAQUE || !boundary_is_met(&cover, materials, key, &hit);
        const int replaces = is_opaque | (is_wall & (material->boundary == BOUNDARY_DIELECTRIC));
        if (replaces) shown = hit;
        if (is_opaque) break;
        if (replaces) {
            is_wall = 0;
            ray.t_max =
                hit.t + touching_distance(triangle, madd3(ray.origin, direction, hit.t), direction);
        }
        const uint crossed = cross_boundary(stack, material->medium, triangle, direction);
        tint = scale3(tint, weight_of_crossing(stack, crossed, material->medium));
        if (!replaces) tint = mul3(tint, tint_of_boundary(&cover, materials, &hit));
        stack = crossed;
    }
    if (HAS_LAMP_CONTACTS && is_opaque)
        shown = shown_face(tree, &cover, materials, ray, 1.0f, shown);
    store_hit(hits, stride, slot, &shown);
    if (!HAS_MEDIA) return;
    PLANE(path_media, CONTACT_MEDIA)[slot] = as_float(stack);
    store3(PLANE(path_media, CONTACT_R), stride, slot, tint);
}
