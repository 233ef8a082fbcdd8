// Adds the environment's radiance to paths that left the scene.
//
// reads: rays, hits, throughputs, radiances, environment
//
// writes: radiances
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "lights/environment.cl"
#include "sampling/mis.cl"
#include "shared/path.h"

kernel void shade_miss(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const EnvironmentEntry* restrict environment,
    global const float* restrict rays,
    global const float* restrict hits,
    global const float* restrict throughputs,
    global float* restrict radiances) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int missed = hit_of(hits, stride, slot) == HIT_MISS;
    // A look into a map costs more than vectors of slots save.
    if (HAS_ENVIRONMENT_MAP && !missed) return;
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const float pdf_w = PLANE(throughputs, THROUGHPUT_PDF)[slot];

    // Light sampling could have chosen this direction too: leave it its share (direct: all of it).
    const EnvironmentSample sky = environment_at(environment, &params, direction);
    float weight = 1.0f;
    if (SAMPLE_LIGHTS && params.environment_pmf > 0.0f) {
        const float light_pdf_w = params.environment_pmf * sky.pdf_w;
        const float share = WEIGH_BOTH ? power_heuristic(pdf_w, light_pdf_w) : 0.0f;
        weight = pdf_w == PDF_CERTAIN ? 1.0f : share;
    }
    const Vec3 carried =
        scale3(load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), missed ? weight : 0.0f);
    global float* radiance = PLANE(radiances, RADIANCE_R);
    const Vec3 before = load3(radiance, stride, slot);
    store3(
        radiance, stride, slot, select3(missed, add3(before, mul3(carried, sky.radiance)), before));
}
