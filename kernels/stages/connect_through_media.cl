// Traces the pending connections of a scene with media or smooth thin walls and adds what arrives:
// instead of `occlusion`, which knows neither. One ray meets the index-matched boundaries and the
// walls one after the other and ends at its light: nothing is pushed off a boundary, so no lamp
// below one is missed.
//
// reads: shadows, ids, radiances, nodes, blocks, triangles, materials, media, textures (holes,
// tints)
//
// writes: radiances, fates
//
// One work-item a slot.

#include "geometry/shown_face.cl"
#include "geometry/textured_surface.cl"
#include "lights/connection.cl"
#include "lights/punctual.cl"
#include "media/boundary.cl"
#include "media/homogeneous.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

// What the thin wall at a hit lets straight through, by channel; 0 where it is not smooth.
INLINE Vec3 straight_through(
    const Cover* cover,
    global const DeviceMaterial* materials,
    const Hit* hit,
    const Vec3 direction) {
    const Interaction x =
        find_interaction(cover->triangles, materials, hit->primitive, hit->u, hit->v, direction);
    Surface surface = material_surface(materials + x.material, x.base);
    Vec3 n = x.n;
    if (HAS_TEXTURES) {
        global const float* triangle = cover->triangles + (size_t)TRIANGLE_FLOATS * hit->primitive;
        apply_surface_textures(cover->textures, x.material, triangle, hit->u, hit->v, &surface);
        global const DeviceTexture* bumps =
            texture_row(cover->textures, x.material, TEXTURE_NORMAL);
        if (HAS_NORMAL_MAPS && bumps->width > 0)
            n = mapped_normal(cover->textures, bumps, triangle, hit->u, hit->v, x.ng, direction);
    }
    return gltf_straight_through(surface, -dot3(n, direction));
}

kernel void connect_through_media(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const BvhNode* restrict nodes,
    global const TriangleBlock* restrict blocks,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const DeviceMedium* restrict media,
    TEXTURE_PARAMETERS,
    global const float* restrict shadows,
    global const uint* restrict ids,
    global float* restrict radiances,
    global uchar* restrict fates) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const float t_max = open_connection(shadows, fates, stride, slot);
    if (t_max <= 0.0f) return;
    const Tree tree = make_tree(nodes, blocks);
    const Ray ray = load_shadow_ray(shadows, stride, slot, t_max);
    const Vec3 direction = ray.direction;
    const float length = sqrt(dot3(direction, direction));
    const int leaves = length > 0.5f * OUTSIDE_SCENE;
    uint stack = HAS_MEDIA ? as_uint(PLANE(shadows, SHADOW_MEDIA)[slot]) : 0;
    Vec3 value = load3(PLANE(shadows, SHADOW_R), stride, slot);
    Vec3 tau = vec3(0.0f, 0.0f, 0.0f);
    RayStart start = at_origin();
    const Cover cover =
        ray_cover(TEXTURES, triangles, HAS_ALPHA ? shadow_cover_key(ids, stride, slot) : 0);
    for (;;) {
        const Hit hit = closest_hit(tree, &ray, start, holes_in(&cover));
        global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * max(hit.primitive, 0);
        global const DeviceMaterial* material = materials + as_int(triangle[TRIANGLE_MATERIAL]);
        Vec3 straight = vec3(0.0f, 0.0f, 0.0f);
        if (HAS_SMOOTH_WALLS && hit.primitive >= 0 && hit.t < 1.0f &&
            material->boundary == BOUNDARY_OPAQUE && material->transmission > 0.0f)
            straight = straight_through(&cover, materials, &hit, scale3(direction, 1.0f / length));
        const int is_wall = max_component3(straight) > 0.0f;
        const int ends =
            hit.primitive < 0 || (material->boundary < BOUNDARY_INDEX_MATCHED && !is_wall);
        if (hit.primitive >= 0 && ends && hit.t < 1.0f) return;
        // what leaves the scene has left all media: of an open mesh too
        const uint innermost = ends && leaves ? 0u : innermost_medium(stack);
        const float end = ends ? 1.0f : min(hit.t, 1.0f);
        if (innermost > 0)
            tau = madd3(
                tau, extinction(media + (int)innermost - 1), max(end - start.t, 0.0f) * length);
        if (ends) {
            const int lamp = LAMPS_ON_LAMPS ? as_int(PLANE(shadows, SHADOW_LAMP)[slot]) : -1;
            if (lamp >= 0 && hit.primitive >= 0) {
                const Hit shown = shown_face(tree, &cover, materials, ray, length, hit);
                triangle = triangles + (size_t)TRIANGLE_FLOATS * shown.primitive;
                if (shown.primitive < lamp && emits_towards(triangle, materials, direction)) return;
            }
            break;
        }
        start = ray_start(hit.t, hit.primitive);
        if (is_wall) {
            value = mul3(value, straight);
            continue;
        }
        const uint crossed = cross_boundary(stack, material->medium, triangle, direction);
        value = mul3(value, tint_of_boundary(&cover, materials, &hit));
        value = scale3(value, share_of_boundary(&cover, materials, &hit));
        value = scale3(value, weight_of_crossing(stack, crossed, material->medium));
        stack = crossed;
    }
    global float* radiance = PLANE(radiances, RADIANCE_R);
    store3(
        radiance, stride, slot,
        add3(load3(radiance, stride, slot), mul3(value, transmittance(tau))));
}
