// What a ray needs to know of a boundary that it passes besides the media.
#pragma once

#include "geometry/bvh.cl"
#include "geometry/surface_texture.cl"
#include "media/boundary_share.cl"
#include "media/medium_stack.cl"

// The base colour at a hit.
INLINE Vec3
tint_of_boundary(const Cover* cover, global const DeviceMaterial* materials, const Hit* hit) {
    global const float* triangle = cover->triangles + (size_t)TRIANGLE_FLOATS * hit->primitive;
    const int index = as_int(triangle[TRIANGLE_MATERIAL]);
    global const DeviceMaterial* material = materials + index;
    Vec3 tint = vec3(material->base_r, material->base_g, material->base_b);
    if (HAS_VERTEX_COLORS)
        tint = mul3(tint, interpolate(triangle, TRIANGLE_COLORS, hit->u, hit->v));
    if (HAS_TEXTURES) {
        const Texel t = texture_on_triangle(
            cover->textures, texture_row(cover->textures, index, TEXTURE_BASE_COLOR), triangle,
            hit->u, hit->v);
        tint = mul3(tint, vec3(t.r, t.g, t.b));
    }
    return tint;
}

// [1] The weight of the boundary where it is hit, beside its opaque rest.
INLINE float share_of_boundary(
    const Cover* cover, global const DeviceMaterial* materials, const Hit* hit) {
    if (!PARTIAL_BOUNDARIES) return 1.0f;
    global const float* triangle = cover->triangles + (size_t)TRIANGLE_FLOATS * hit->primitive;
    const int index = as_int(triangle[TRIANGLE_MATERIAL]);
    float transmission = materials[index].transmission;
    float metallic = materials[index].metallic;
    if (HAS_LOBE_TEXTURES) {
        const Texel through = texture_on_triangle(
            cover->textures, texture_row(cover->textures, index, TEXTURE_TRANSMISSION), triangle,
            hit->u, hit->v);
        const Texel lobe = texture_on_triangle(
            cover->textures, texture_row(cover->textures, index, TEXTURE_METALLIC_ROUGHNESS),
            triangle, hit->u, hit->v);
        transmission *= through.r;
        metallic *= lobe.b;
    }
    return boundary_share(transmission, metallic);
}

// Whether the ray of this key meets the boundary that it hits, not its opaque rest.
INLINE int boundary_is_met(
    const Cover* cover, global const DeviceMaterial* materials, const uint key, const Hit* hit) {
    return !PARTIAL_BOUNDARIES ||
           meets_boundary(key, hit->primitive, share_of_boundary(cover, materials, hit));
}
