// What textures and vertex attributes say at a point of a triangle.
#pragma once

#include "geometry/attributes.cl"
#include "materials/texture.cl"
#include "sampling/rng.cl"

// The texture at barycentrics (u, v).
INLINE Texel texture_on_triangle(
    const Textures textures,
    global const DeviceTexture* row,
    global const float* triangle,
    const float u,
    const float v) {
    if (UV_SETS == 0 || row->width == 0) return texel(1.0f, 1.0f, 1.0f, 1.0f);
    const int set = UV_SETS > 1 && (row->flags & TEXTURE_SECOND_UVS) != 0;
    const int attribute = TRIANGLE_UVS + 6 * set;
    const float x = interpolate_float(triangle, attribute, 2, u, v);
    const float y = interpolate_float(triangle, attribute + 1, 2, u, v);
    return texture_eval(
        textures, row, fma(row->s_u, x, fma(row->s_v, y, row->s_1)),
        fma(row->t_u, x, fma(row->t_v, y, row->t_1)));
}

// The share of the point that is there [1]: 1, or 0 in the holes of a mask [glTF 2.0,
// section 3.9.4].
INLINE float cover_of(
    const Textures textures, global const float* triangle, const float u, const float v) {
    global const DeviceTexture* row =
        texture_row(textures, as_int(triangle[TRIANGLE_MATERIAL]), TEXTURE_BASE_COLOR);
    if ((row->flags & (TEXTURE_MASK | TEXTURE_BLEND)) == 0) return 1.0f;
    float alpha = row->scale * texture_on_triangle(textures, row, triangle, u, v).a;
    if (HAS_VERTEX_ALPHAS) alpha *= interpolate_float(triangle, TRIANGLE_ALPHAS, 1, u, v);
    if ((row->flags & TEXTURE_MASK) != 0) return alpha >= row->cutoff ? 1.0f : 0.0f;
    return alpha;
}

// What textures and vertex colours leave of a material's emission at the point.
INLINE Vec3 emission_on_triangle(
    const Textures textures, global const float* triangle, const float u, const float v) {
    global const DeviceTexture* row =
        texture_row(textures, as_int(triangle[TRIANGLE_MATERIAL]), TEXTURE_EMISSION);
    const Texel t = texture_on_triangle(textures, row, triangle, u, v);
    const Vec3 rgb = vec3(t.r, t.g, t.b);
    if (HAS_VERTEX_COLORS && (row->flags & TEXTURE_TINTED) != 0)
        return mul3(rgb, interpolate(triangle, TRIANGLE_COLORS, u, v));
    return rgb;
}

// What a ray needs to know to pass through holes. `key`: random bits of the ray's own.
typedef struct {
    Textures textures;
    global const float* triangles;
    uint key;
} Cover;

INLINE Cover ray_cover(const Textures textures, global const float* triangles, const uint key) {
    Cover cover;
    cover.textures = textures;
    cover.triangles = triangles;
    cover.key = key;
    return cover;
}

// Of a scene without holes.
INLINE Cover full_cover(void) {
    return ray_cover(texture_memory(0, 0, 0, 0, 0), 0, 0);
}

// What closest_hit and any_hit take: nothing where no surface has holes, for the struct in memory
// made shadow rays 4 % slower and others up to 5 % (docs/design/intersect.md).
INLINE const Cover* holes_in(const Cover* cover) {
    return HAS_ALPHA ? cover : 0;
}

// Whether the ray is stopped at this point of a triangle. A share of all rays, chosen by their key
// and the triangle's id: so the order of the tree decides nothing, nor does a triangle that stands
// in two leaves count twice.
INLINE int stops_ray(const Cover* cover, const int primitive, const float u, const float v) {
    const float share =
        cover_of(cover->textures, cover->triangles + (size_t)TRIANGLE_FLOATS * primitive, u, v);
    return unit_float(hash_pair(cover->key, (uint)primitive)) < share;
}
