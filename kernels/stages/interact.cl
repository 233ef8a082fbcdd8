// Looks up what each ray hit: position, normals, base colour, material, light.
//
// reads: rays, hits, triangles, materials
//
// writes: surfaces
//
// One work-item a slot.

#include "geometry/interaction.cl"
#include "geometry/path_state.cl"
#include "shared/params.h"

kernel void interact(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const float* restrict rays,
    global const float* restrict hits,
    global float* restrict surfaces) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    if (!at_surface(primitive)) return;
    const Interaction x = find_interaction(
        triangles, materials, primitive, PLANE(hits, HIT_U)[slot], PLANE(hits, HIT_V)[slot],
        load3(PLANE(rays, RAY_DIRECTION_X), stride, slot));
    store3(PLANE(surfaces, SURFACE_X), stride, slot, x.p);
    store3(PLANE(surfaces, SURFACE_NG_X), stride, slot, x.ng);
    store3(PLANE(surfaces, SURFACE_BASE_R), stride, slot, x.base);
    PLANE(surfaces, SURFACE_MATERIAL)[slot] = as_float(x.material);
    PLANE(surfaces, SURFACE_LIGHT)[slot] = as_float(x.light);
    if (HAS_SHADING_NORMALS) store3(PLANE(surfaces, SURFACE_N_X), stride, slot, x.n);
}
