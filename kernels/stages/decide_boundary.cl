// Decides where a path hits a boundary that transmits in part whether it meets the boundary or the
// opaque rest of the surface, which stands in the table of materials `material_count` rows behind.
// Later stages see one or the other.
//
// reads: rays, hits, ids, surfaces, materials
//
// writes: surfaces
//
// One work-item a slot. `find_contacts` has decided the same before, by the same random number.

#include "geometry/interaction.cl"
#include "geometry/path_state.cl"
#include "media/boundary_share.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

kernel void decide_boundary(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const DeviceMaterial* restrict materials,
    global const float* restrict rays,
    global const float* restrict hits,
    global const uint* restrict ids,
    global float* restrict surfaces) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    if (!at_surface(primitive)) return;
    const int row = as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
    if (materials[row].boundary == BOUNDARY_OPAQUE) return;
    const Surface surface = load_surface(materials, surfaces, stride, slot);
    const float share = boundary_share(surface.transmission, surface.metallic);
    if (meets_boundary(share_key(ids, rays, stride, slot), primitive, share)) return;
    PLANE(surfaces, SURFACE_MATERIAL)[slot] = as_float(row + (int)params.material_count);
    if (HAS_LOBE_TEXTURES) {
        PLANE(surfaces, SURFACE_METALLIC)[slot] = surface.metallic / (1.0f - share);
        PLANE(surfaces, SURFACE_TRANSMISSION)[slot] = 0.0f;
    }
}
