// Multiplies what `interact` found by what textures say at the point, and bends the shading normal.
//
// reads: rays, hits, surfaces, triangles, materials, textures
//
// writes: surfaces
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "geometry/textured_surface.cl"
#include "shared/params.h"

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
    const int primitive = hit_of(hits, stride, slot);
    if (!at_surface(primitive)) return;
    const float u = PLANE(hits, HIT_U)[slot];
    const float v = PLANE(hits, HIT_V)[slot];
    const int index = as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
    global const DeviceMaterial* material = materials + index;
    global const float* triangle = triangles + (size_t)TRIANGLE_FLOATS * primitive;
    const Textures memory = TEXTURES;

    Surface surface =
        material_surface(material, load3(PLANE(surfaces, SURFACE_BASE_R), stride, slot));
    apply_surface_textures(memory, index, triangle, u, v, &surface);
    store3(PLANE(surfaces, SURFACE_BASE_R), stride, slot, surface.base);
    if (HAS_SPECULAR && HAS_LOBE_TEXTURES) {
        PLANE(surfaces, SURFACE_TRANSMISSION)[slot] = surface.transmission;
        PLANE(surfaces, SURFACE_METALLIC)[slot] = surface.metallic;
        PLANE(surfaces, SURFACE_ALPHA)[slot] = surface.alpha;
        PLANE(surfaces, SURFACE_SPECULAR)[slot] = surface.specular;
        store3(PLANE(surfaces, SURFACE_F0_R), stride, slot, surface.f0);
    }

    global const DeviceTexture* bumps = texture_row(memory, index, TEXTURE_NORMAL);
    if (HAS_NORMAL_MAPS && bumps->width > 0) {
        const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
        const Vec3 ng = load3(PLANE(surfaces, SURFACE_NG_X), stride, slot);
        store3(
            PLANE(surfaces, SURFACE_N_X), stride, slot,
            mapped_normal(memory, bumps, triangle, u, v, ng, direction));
    }
}
