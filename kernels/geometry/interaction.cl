// Where a ray met a surface, and what it met.
#pragma once

#include "geometry/attributes.cl"
#include "geometry/shading_normal.cl"
#include "materials/gltf_material.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/path.h"
#include "shared/scene.h"

// How far a ray starts off its surface, along the geometric normal, in the unit cube. The scene is
// normalised, so one number serves all: hit points from barycentrics are right to 1e-7, a tenth of
// this.
#define RAY_OFFSET 0x1p-20f

// The same at p: outside the unit cube rounding grows with the distance from it, and triangles with
// it (prepare/subdivide.h). Not by the largest coordinate: of three absolute values LLVM's SLP pass
// makes a vector, and the kernels around them stay scalar on PoCL.
INLINE float ray_offset(const Vec3 p) {
    if (!HAS_FAR_GEOMETRY) return RAY_OFFSET;
    return RAY_OFFSET * sqrt(max(1.0f, 4.0f * dot3(p, p)));
}

typedef struct {
    Vec3 p;     // position [normalised]
    Vec3 ng;    // geometric normal, unit, on the viewer's side
    Vec3 n;     // shading normal, unit, on the viewer's side
    Vec3 base;  // base colour [1]
    int material;
    uint light;  // row of the light table if it emits towards the viewer, else NO_LIGHT
} Interaction;

INLINE Interaction find_interaction(
    global const float* triangles,
    global const DeviceMaterial* materials,
    const int primitive,
    const float u,
    const float v,
    const Vec3 direction) {
    global const float* triangle = triangles + TRIANGLE_FLOATS * primitive;
    Interaction r;
    r.material = as_int(triangle[TRIANGLE_MATERIAL]);
    global const DeviceMaterial* material = materials + r.material;
    r.p = interpolate(triangle, TRIANGLE_CORNERS, u, v);
    const Vec3 face = normalize3(triangle_cross(triangle));
    const int front = dot3(face, direction) < 0.0f;
    r.ng = scale3(face, front ? 1.0f : -1.0f);
    r.n = r.ng;
    if (HAS_VERTEX_NORMALS) {
        const Vec3 sum = interpolate(triangle, TRIANGLE_NORMALS, u, v);
        const Vec3 smooth = scale3(normalize3(sum), front ? 1.0f : -1.0f);
        r.n = visible_normal(smooth, r.ng, scale3(direction, -1.0f));
    }
    r.base = vec3(material->base_r, material->base_g, material->base_b);
    if (HAS_VERTEX_COLORS) r.base = mul3(r.base, interpolate(triangle, TRIANGLE_COLORS, u, v));
    r.light = front || material->double_sided ? as_uint(triangle[TRIANGLE_LIGHT]) : NO_LIGHT;
    if (HAS_LAMP_CONTACTS) r.light = r.light == AT_LAMP ? NO_LIGHT : r.light;
    return r;
}

// Whether the face of the triangle that a ray of this direction meets emits.
INLINE int emits_towards(
    global const float* triangle, global const DeviceMaterial* materials, const Vec3 direction) {
    const int emits = as_uint(triangle[TRIANGLE_LIGHT]) < AT_LAMP;
    const int front = dot3(triangle_cross(triangle), direction) < 0.0f;
    return emits & (front | (materials[as_int(triangle[TRIANGLE_MATERIAL])].double_sided != 0));
}

// The lobes of a material whose base colour at the point is `base`.
INLINE Surface material_surface(global const DeviceMaterial* material, const Vec3 base) {
    Surface s;
    s.base = base;
    if (!HAS_SPECULAR) return s;
    s.f0 = vec3(material->f0_r, material->f0_g, material->f0_b);
    s.metallic = material->metallic;
    s.specular = material->specular;
    s.alpha = material->alpha;
    s.transmission = material->transmission;
    return s;
}

// The lobes of slot `slot`'s surface.
INLINE Surface load_surface(
    global const DeviceMaterial* materials,
    global const float* surfaces,
    const size_t stride,
    const size_t slot) {
    const Vec3 base = load3(PLANE(surfaces, SURFACE_BASE_R), stride, slot);
    if (!(HAS_SPECULAR && HAS_LOBE_TEXTURES))
        return material_surface(materials + as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]), base);
    Surface s;
    s.base = base;
    s.f0 = load3(PLANE(surfaces, SURFACE_F0_R), stride, slot);
    s.metallic = PLANE(surfaces, SURFACE_METALLIC)[slot];
    s.specular = PLANE(surfaces, SURFACE_SPECULAR)[slot];
    s.alpha = PLANE(surfaces, SURFACE_ALPHA)[slot];
    s.transmission = PLANE(surfaces, SURFACE_TRANSMISSION)[slot];
    return s;
}

INLINE Vec3
load_shading_normal(global const float* surfaces, const size_t stride, const size_t slot) {
    return load3(PLANE(surfaces, HAS_SHADING_NORMALS ? SURFACE_N_X : SURFACE_NG_X), stride, slot);
}

// The start of a ray that leaves the surface on the side of the normal `ng`.
INLINE Vec3 leave(const Vec3 p, const Vec3 ng) {
    return madd3(p, ng, ray_offset(p));
}
