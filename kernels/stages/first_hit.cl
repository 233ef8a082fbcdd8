// Records what the camera saw first: albedo, shading normal, distance.
//
// reads: hits, surfaces, ids, radiances
//
// writes: radiances (the sums)
//
// One work-item a slot.

#include "geometry/interaction.cl"
#include "geometry/path_state.cl"
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
    if (PLANE(ids, ID_SCATTERING)[slot] != 0) return;
    const int primitive = hit_of(hits, stride, slot);
    if (primitive == HIT_IDLE) return;
    if (is_traced(hits, stride, slot)) return;  // a child after the first
    const int hit = at_surface(primitive);
    const float kept =
        PLANE(ids, ID_SAMPLE)[slot] == 0 ? 0.0f : 1.0f;  // a unit's first sample starts its sums
    const Vec3 zero = vec3(0.0f, 0.0f, 0.0f);
    const Vec3 base = select3(hit, load3(PLANE(surfaces, SURFACE_BASE_R), stride, slot), zero);
    const Vec3 n = select3(hit, load_shading_normal(surfaces, stride, slot), zero);
    float t = PLANE(hits, HIT_T)[slot];
    if (HAS_MEDIA | HAS_CONTACTS | HAS_FAR_CAMERA) t += params.ray_start;
    const float depth = hit ? t * params.metres : 0.0f;
    global float* albedo = PLANE(radiances, SUM_ALBEDO_R);
    global float* normal = PLANE(radiances, SUM_NORMAL_X);
    store3(albedo, stride, slot, madd3(base, load3(albedo, stride, slot), kept));
    store3(normal, stride, slot, madd3(n, load3(normal, stride, slot), kept));
    PLANE(radiances, SUM_DEPTH)[slot] = fma(PLANE(radiances, SUM_DEPTH)[slot], kept, depth);
    PLANE(radiances, SUM_COVERAGE)
    [slot] = fma(PLANE(radiances, SUM_COVERAGE)[slot], kept, hit ? 1.0f : 0.0f);
}
