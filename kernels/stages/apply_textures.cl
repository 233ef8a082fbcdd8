// Multiplies what `interact` found by what textures say at the point, and bends the shading normal.
//
// reads: rays, hits, scene, textures
//
// writes: surfaces
//
// One work-item a slot.

#include "geometry/interaction.cl"
#include "geometry/surface_texture.cl"
#include "shared/params.h"

// Of a normal map, unit, towards the front: x along the tangent, y along the bitangent [glTF 2.0,
// section 3.7.2.1]. Neither is made orthogonal or unit before they are weighed, as MikkTSpace asks
// for.
INLINE Vec3 mapped_normal(
    const Textures textures,
    global const DeviceTexture* row,
    global const float* triangle,
    const float u,
    const float v) {
    const Texel t = texture_on_triangle(textures, row, triangle, u, v);
    const Vec3 smooth = HAS_VERTEX_NORMALS ? interpolate(triangle, TRIANGLE_NORMALS, u, v)
                                           : normalize3(triangle_cross(triangle));
    const Vec3 tangent = interpolate(triangle, TRIANGLE_TANGENTS, u, v);
    const Vec3 bitangent = scale3(cross3(smooth, tangent), triangle[TRIANGLE_BITANGENT]);
    const Vec3 bent = madd3(
        madd3(scale3(smooth, fma(2.0f, t.b, -1.0f)), tangent, row->scale * fma(2.0f, t.r, -1.0f)),
        bitangent, row->scale * fma(2.0f, t.g, -1.0f));
    const float length2 = dot3(bent, bent);
    return length2 > 1e-12f ? scale3(bent, 1.0f / sqrt(length2)) : normalize3(smooth);
}

kernel void apply_textures(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    TEXTURE_PARAMETERS,
    global const float* restrict rays,
    global const float* restrict hits,
    global float* restrict surfaces) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
    if (primitive < 0) return;
    const float u = PLANE(hits, HIT_U)[slot];
    const float v = PLANE(hits, HIT_V)[slot];
    const int index = as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
    global const DeviceMaterial* material = materials + index;
    global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * primitive;
    const Textures memory = TEXTURES;

    const Texel base =
        texture_on_triangle(memory, texture_row(memory, index, TEXTURE_BASE_COLOR), triangle, u, v);
    const Vec3 factor = load3(PLANE(surfaces, SURFACE_BASE_R), stride, slot);
    store3(
        PLANE(surfaces, SURFACE_BASE_R), stride, slot, mul3(factor, vec3(base.r, base.g, base.b)));

    if (HAS_SPECULAR && HAS_LOBE_TEXTURES) {
        const Texel lobe = texture_on_triangle(
            memory, texture_row(memory, index, TEXTURE_METALLIC_ROUGHNESS), triangle, u, v);
        const Texel weight = texture_on_triangle(
            memory, texture_row(memory, index, TEXTURE_SPECULAR), triangle, u, v);
        const Texel tint = texture_on_triangle(
            memory, texture_row(memory, index, TEXTURE_SPECULAR_COLOR), triangle, u, v);
        const Texel through = texture_on_triangle(
            memory, texture_row(memory, index, TEXTURE_TRANSMISSION), triangle, u, v);
        PLANE(surfaces, SURFACE_TRANSMISSION)[slot] = material->transmission * through.r;
        PLANE(surfaces, SURFACE_METALLIC)[slot] = material->metallic * lobe.b;
        PLANE(surfaces, SURFACE_ALPHA)[slot] = material->alpha * lobe.g * lobe.g;
        PLANE(surfaces, SURFACE_SPECULAR)[slot] = material->specular * weight.a;
        // where a texture tints it, the material holds it unclamped
        PLANE(surfaces, SURFACE_F0_R)[slot] = min(material->f0_r * tint.r, 1.0f);
        PLANE(surfaces, SURFACE_F0_G)[slot] = min(material->f0_g * tint.g, 1.0f);
        PLANE(surfaces, SURFACE_F0_B)[slot] = min(material->f0_b * tint.b, 1.0f);
    }

    global const DeviceTexture* bumps = texture_row(memory, index, TEXTURE_NORMAL);
    if (HAS_NORMAL_MAPS && bumps->width > 0) {
        const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
        const Vec3 ng = load3(PLANE(surfaces, SURFACE_NG_X), stride, slot);
        const float side = dot3(triangle_cross(triangle), ng) < 0.0f ? -1.0f : 1.0f;
        const Vec3 n = scale3(mapped_normal(memory, bumps, triangle, u, v), side);
        store3(
            PLANE(surfaces, SURFACE_N_X), stride, slot,
            visible_normal(n, ng, scale3(direction, -1.0f)));
    }
}
