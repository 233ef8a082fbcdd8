// A surface with its textures: its lobes and its shading normal at a point of a triangle.
#pragma once

#include "geometry/interaction.cl"
#include "geometry/surface_texture.cl"

// Multiplies the lobes of material `index` by what textures say at the point.
INLINE void apply_surface_textures(
    const Textures textures,
    const int index,
    global const float* triangle,
    const float u,
    const float v,
    Surface* s) {
    const Texel base = texture_on_triangle(
        textures, texture_row(textures, index, TEXTURE_BASE_COLOR), triangle, u, v);
    s->base = mul3(s->base, vec3(base.r, base.g, base.b));
    if (!(HAS_SPECULAR && HAS_LOBE_TEXTURES)) return;
    const Texel lobe = texture_on_triangle(
        textures, texture_row(textures, index, TEXTURE_METALLIC_ROUGHNESS), triangle, u, v);
    const Texel weight = texture_on_triangle(
        textures, texture_row(textures, index, TEXTURE_SPECULAR), triangle, u, v);
    const Texel tint = texture_on_triangle(
        textures, texture_row(textures, index, TEXTURE_SPECULAR_COLOR), triangle, u, v);
    const Texel through = texture_on_triangle(
        textures, texture_row(textures, index, TEXTURE_TRANSMISSION), triangle, u, v);
    s->transmission *= through.r;
    s->metallic *= lobe.b;
    s->alpha = s->alpha * lobe.g * lobe.g;
    s->specular *= weight.a;
    // where a texture tints it, the material holds it unclamped
    s->f0 =
        vec3(min(s->f0.x * tint.r, 1.0f), min(s->f0.y * tint.g, 1.0f), min(s->f0.z * tint.b, 1.0f));
}

// Of a normal map, unit, seen from where a ray of this direction comes: x along the tangent, y
// along the bitangent [glTF 2.0, section 3.7.2.1]. Neither is made orthogonal or unit before they
// are weighed, as MikkTSpace asks for.
INLINE Vec3 mapped_normal(
    const Textures textures,
    global const DeviceTexture* row,
    global const float* triangle,
    const float u,
    const float v,
    const Vec3 ng,
    const Vec3 direction) {
    const Texel t = texture_on_triangle(textures, row, triangle, u, v);
    const Vec3 smooth = HAS_VERTEX_NORMALS ? interpolate(triangle, TRIANGLE_NORMALS, u, v)
                                           : normalize3(triangle_cross(triangle));
    const Vec3 tangent = interpolate(triangle, TRIANGLE_TANGENTS, u, v);
    const Vec3 bitangent = scale3(cross3(smooth, tangent), triangle[TRIANGLE_BITANGENT]);
    const Vec3 bent = madd3(
        madd3(scale3(smooth, fma(2.0f, t.b, -1.0f)), tangent, row->scale * fma(2.0f, t.r, -1.0f)),
        bitangent, row->scale * fma(2.0f, t.g, -1.0f));
    const float length2 = dot3(bent, bent);
    const Vec3 front = length2 > 1e-12f ? scale3(bent, 1.0f / sqrt(length2)) : normalize3(smooth);
    const float side = dot3(triangle_cross(triangle), ng) < 0.0f ? -1.0f : 1.0f;
    return visible_normal(scale3(front, side), ng, scale3(direction, -1.0f));
}
