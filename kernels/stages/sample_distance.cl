// Decides where a path in a medium stops on the way to the surface it would hit (notes 6, with
// sigma_t in alpha), and adds what the medium emits along the way.
//
// reads: rays, ids, media
//
// writes: hits and positions (a stop), throughputs, radiances
//
// One work-item a slot. A ray that misses everything has left all media, whatever its stack says:
// the mesh was not closed.

#include "media/homogeneous.cl"
#include "media/medium_stack.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

// A stop keeps this distance from the ends of its segment, so that rounding does not carry it over
// a boundary; half a segment if that is shorter.
#define STOP_MARGIN 0x1p-21f

kernel void sample_distance(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const DeviceMedium* restrict media,
    global const float* restrict rays,
    global const uint* restrict ids,
    global const float* restrict path_media,
    global float* restrict hits,
    global float* restrict surfaces,
    global float* restrict throughputs,
    global float* restrict radiances) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
    const uint innermost = innermost_medium(as_uint(PLANE(path_media, MEDIUM_STACK)[slot]));
    if (primitive < 0) return;
    if (innermost == 0) return;
    global const DeviceMedium* medium = media + (int)innermost - 1;
    const float start = PLANE(path_media, MEDIUM_T)[slot];
    const float end = PLANE(hits, HIT_T)[slot];
    const float length = end - start;
    const Vec3 throughput = load3(PLANE(throughputs, THROUGHPUT_R), stride, slot);

    // emission of the whole segment, whatever becomes of the path: it needs no sampling
    const Vec3 tau = scale3(extinction(medium), length);
    const Vec3 reaching =
        vec3(mean_of_exp_minus(tau.x), mean_of_exp_minus(tau.y), mean_of_exp_minus(tau.z));
    const Vec3 emission = vec3(medium->emission_r, medium->emission_g, medium->emission_b);
    global float* radiance = PLANE(radiances, RADIANCE_R);
    store3(
        radiance, stride, slot,
        madd3(load3(radiance, stride, slot), mul3(mul3(throughput, emission), reaching), length));

    // every segment of a ray draws numbers of its own
    const uint passes = as_uint(PLANE(path_media, MEDIUM_PASSES)[slot]);
    const uint seed = PLANE(ids, ID_SEED)[slot];
    const Sample2 u = unit_pair(scattering_pair(
        passes > 0 ? hash_pair(seed, passes) : seed, PLANE(ids, ID_INDEX)[slot], 0,
        PLANE(ids, ID_SCATTERING)[slot], PAIR_DISTANCE));
    const MediumEvent event = sample_exponential(medium, length, channel_pmf(throughput), u);
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, mul3(throughput, event.weight));

    const float margin = min(STOP_MARGIN, 0.5f * length);
    const float stop = start + clamp(event.distance, start > 0.0f ? margin : 0.0f, length - margin);
    const Vec3 origin = load3(PLANE(rays, RAY_ORIGIN_X), stride, slot);
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(event.stops ? HIT_MEDIUM : primitive);
    PLANE(hits, HIT_T)[slot] = event.stops ? stop : end;
    store3(PLANE(surfaces, SURFACE_X), stride, slot, madd3(origin, direction, stop));
    PLANE(surfaces, SURFACE_MATERIAL)[slot] = as_float(0);  // a valid index for whoever looks
}
