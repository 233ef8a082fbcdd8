// Decides where a path in a medium stops on the way to the surface it would hit (notes 6, with
// sigma_t in alpha), and adds what the medium emits along the way. A segment that branches is
// passed first, with weight exp(-tau), and stopped on by its other children.
//
// reads: rays, hits, throughputs, radiances, path_media, ids, branches, triangles, lights, media
//
// writes: hits, surfaces (a stop), throughputs, radiances, ids, branches
//
// One work-item a slot. A ray that misses everything has left all media, whatever its stack says:
// the mesh was not closed.

#include "geometry/path_state.cl"
#include "lights/light_point.cl"
#include "media/homogeneous.cl"
#include "media/medium_stack.cl"
#include "sampling/branch.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

// A stop keeps this part of ray_offset from boundaries, half an ulp of a distance across the scene,
// so that rounding seldom carries it over one; half a segment if that is shorter. Eight times as
// much made dense media dark (docs/stability.md).
#define STOP_MARGIN 0x1p-4f

kernel void sample_distance(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceLight* restrict lights,
    global const DeviceMedium* restrict media,
    global const float* restrict rays,
    global const float* restrict path_media,
    global float* restrict hits,
    global float* restrict surfaces,
    global float* restrict throughputs,
    global float* restrict radiances,
    global uint* restrict ids,
    global float* restrict branches) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    const uint innermost = innermost_medium(as_uint(PLANE(path_media, MEDIUM_STACK)[slot]));
    const Vec3 origin = load3(PLANE(rays, RAY_ORIGIN_X), stride, slot);
    if (HAS_SPLITS && primitive == HIT_MEDIUM) {
        store3(PLANE(surfaces, SURFACE_X), stride, slot, origin);  // a stop that is resumed
        PLANE(surfaces, SURFACE_MATERIAL)[slot] = as_float(0);
    }
    if (!at_surface(primitive) && primitive != HIT_LEAVING) return;
    if (innermost == 0) return;
    if (is_resumed(hits, stride, slot)) return;
    const int resumed = is_traced(hits, stride, slot);
    const float hit_t = PLANE(hits, HIT_T)[slot];
    global const DeviceMedium* medium = media + (int)innermost - 1;
    const float start = PLANE(path_media, MEDIUM_T)[slot];
    const float end = fabs(hit_t);
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
        madd3(
            load3(radiance, stride, slot), mul3(mul3(throughput, emission), reaching),
            resumed ? 0.0f : length));

    // between faces that touch a stop would not be on the side of all that it was on
    const float least = PLANE(path_media, MEDIUM_TOUCHING)[slot];
    const int scatters =
        MEDIA_SCATTER && (max_component3(scattering_of(medium)) > 0.0f) & (length > least);
    uint branch = HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0;
    int branching = 0;
    if (HAS_SPLITS) {
        const uint stacked = PLANE(ids, ID_STACK)[slot];
        const uint level = resumed ? stacked - 1 : stacked;
        const int first = (stacked & 1u) == 0u && level < BRANCH_LEVELS * params.split_depth;
        branching = resumed | (scatters & first & (DISTANCES != DISTANCE_EXPONENTIAL));
        if (branching) {
            global float* segment = branch_at(branches, stride, level);
            if (!resumed) {
                const BranchingPath path = {stride,      slot,       rays, hits,
                                            throughputs, path_media, ids,  branches};
                open_branch(&path, level, stacked, -end, 1, origin);
                store3(PLANE(segment, BRANCH_R), stride, slot, throughput);
            }
            const uint left =
                resumed ? as_uint(PLANE(segment, BRANCH_LEFT)[slot]) : params.stops + 1;
            PLANE(segment, BRANCH_LEFT)[slot] = as_float(left - 1);
            branch = branch_child(branch, params.stops + 1, left);
            PLANE(ids, ID_BRANCH)[slot] = branch;
        }
    }

    // every segment of a ray draws numbers of its own
    const uint passes = as_uint(PLANE(path_media, MEDIUM_PASSES)[slot]);
    const uint seed = PLANE(ids, ID_SEED)[slot];
    const uint index = PLANE(ids, ID_INDEX)[slot];
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const Sample2 u = unit_pair(scattering_pair(
        passes > 0 ? hash_pair(seed, passes) : seed, index, branch, scattering, PAIR_DISTANCE));
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const Vec3 pmf = channel_pmf(throughput);
    MediumEvent event;
    if (DISTANCES == DISTANCE_EXPONENTIAL) {
        event = sample_exponential(medium, length, pmf, u);
    } else {
        View view = no_view();
        if (DISTANCES >= DISTANCE_EQUIANGULAR) {
            const LightPoint point =
                light_point(triangles, lights, &params, seed, index, branch, scattering);
            const View seen =
                view_from(sub3(point.p, madd3(origin, direction, start)), direction, length);
            view.start = point.exists ? seen.start : view.start;
            view.height = point.exists ? seen.height : view.height;
            view.angle = point.exists ? seen.angle : view.angle;
        }
        event = sample_stop_or_pass(medium, length, pmf, view, u);
        if (HAS_SPLITS) {
            const MediumEvent stop = sample_stop(medium, length, absorptance(tau), pmf, view, u);
            const Vec3 child = select3(
                resumed, scale3(stop.weight, 1.0f / (float)params.stops), transmittance(tau));
            event.stops = branching ? resumed : event.stops;
            event.distance = branching ? stop.distance : event.distance;
            event.weight = select3(branching, child, event.weight);
        }
    }
    // what does not scatter is passed for certain
    event.stops = scatters ? event.stops : 0;
    event.weight = select3(scatters, event.weight, transmittance(tau));
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, mul3(throughput, event.weight));

    const float margin =
        min(STOP_MARGIN * ray_offset(madd3(origin, direction, end)), 0.5f * length);
    // behind a dielectric a quarter of the way to the ray's origin, ray_offset / 4 deep
    const float nearest = start > 0.0f ? margin : min(-0.25f * start, 0.5f * length);
    const float stop = start + clamp(event.distance, nearest, length - margin);
    const int passes_to = primitive == HIT_LEAVING ? HIT_MISS : primitive;
    set_hit(hits, stride, slot, event.stops ? HIT_MEDIUM : passes_to);
    const float stop_t = max(stop, FLT_MIN);
    PLANE(hits, HIT_T)[slot] = event.stops ? (resumed ? -stop_t : stop_t) : end;
    store3(PLANE(surfaces, SURFACE_X), stride, slot, madd3(origin, direction, stop));
    PLANE(surfaces, SURFACE_MATERIAL)[slot] = as_float(0);  // a valid index for whoever looks
}
