// Continues every path that stopped in a medium in a direction of its phase function (notes 6), or
// ends it.
//
// reads: surfaces (the position), rays, hits, throughputs, ids, path_media, branches, media
//
// writes: rays, hits (the end), throughputs, ids, path_media, branches
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "lights/guide.cl"
#include "media/medium_stack.cl"
#include "media/phase.cl"
#include "sampling/branch.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

kernel void scatter_medium(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const DeviceMedium* restrict media,
    global const float* restrict surfaces,
    global float* restrict path_media,
    global float* restrict rays,
    global float* restrict hits,
    global float* restrict throughputs,
    global uint* restrict ids,
    global float* restrict branches) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    if (hit_of(hits, stride, slot) != HIT_MEDIUM) return;
    const uint innermost = innermost_medium(as_uint(PLANE(path_media, MEDIUM_STACK)[slot]));
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const Vec3 position = load3(PLANE(surfaces, SURFACE_X), stride, slot);
    const BranchingPath path = {stride, slot, rays, hits, throughputs, path_media, ids, branches};
    const Child child = next_child(&path, params.split_depth, params.stop_directions, position);
    Sample2 u = unit_pair(scattering_pair(
        PLANE(ids, ID_SEED)[slot], PLANE(ids, ID_INDEX)[slot], child.branch, scattering,
        PAIR_DIRECTION));
    const float anisotropy = media[(int)innermost - 1].anisotropy;
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    Guide guide;
    int guided = 0;
    if (HAS_GUIDE) {
        guide = guide_at(&params, position, scattering);
        guided = choose_guided(guide, &u);
    }
    PhaseSample s = phase_sample(anisotropy, direction, u);
    if (HAS_GUIDE) {
        s.wi = select3(guided, guide_sample(guide, u), s.wi);
        const float phase = phase_eval(anisotropy, direction, s.wi);
        const float mixture = guided_pdf_w(guide, guided, s.wi, phase_pdf_w(phase));
        PLANE(hits, HIT_WORTH)[slot] = guide_worth(mixture, phase_pdf_w(phase));
        s.weight = phase / mixture;
        s.pdf_w = mixture;
    }
    const Vec3 throughput = scale3(child.carried, s.weight);
    float goes_on = scattering < params.max_scatterings ? 1.0f : 0.0f;
    goes_on *= throughput.x + throughput.y + throughput.z <= 0.0f ? 0.0f : 1.0f;  // not NaN
    const int continues = goes_on > 0.0f;
    set_hit(hits, stride, slot, continues ? HIT_MEDIUM : HIT_ENDED);
    store3(PLANE(rays, RAY_ORIGIN_X), stride, slot, position);
    store3(PLANE(rays, RAY_DIRECTION_X), stride, slot, s.wi);
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, throughput);
    PLANE(throughputs, THROUGHPUT_PDF)[slot] = s.pdf_w;
    PLANE(ids, ID_SCATTERING)[slot] = scattering + (continues ? 1 : 0);
    start_at_origin(path_media, stride, slot);
}
