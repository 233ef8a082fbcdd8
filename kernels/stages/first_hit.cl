// Records what the camera saw first: albedo, shading normal, distance.
// reads: hits, surfaces, ids    writes: sums
// One work-item a slot.

#include "geometry/interaction.cl"
#include "shared/params.h"

kernel void first_hit(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict hits,
    global const float* restrict surfaces,
    global const uint* restrict ids,
    global float* restrict radiances) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    if (as_int(PLANE(hits, HIT_PRIMITIVE)[slot]) < 0) return;
    if (PLANE(ids, ID_SCATTERING)[slot] != 0) return;
    global float* albedo = PLANE(radiances, SUM_ALBEDO_R);
    global float* normal = PLANE(radiances, SUM_NORMAL_X);
    const Vec3 base = load3(PLANE(surfaces, SURFACE_BASE_R), stride, slot);
    store3(albedo, stride, slot, add3(load3(albedo, stride, slot), base));
    store3(normal, stride, slot, add3(load3(normal, stride, slot), load_shading_normal(surfaces, stride, slot)));
    PLANE(radiances, SUM_DEPTH)[slot] += PLANE(hits, HIT_T)[slot] * params.metres;
    PLANE(radiances, SUM_COVERAGE)[slot] += 1.0f;
}
