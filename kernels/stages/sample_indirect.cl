// Continues every path at a surface in a direction of its bsdf (notes 3 and 5,
// indirectRadianceEstimator), or ends it.
//
// reads: surfaces, rays, hits, throughputs, ids, path_media, branches, materials
//
// writes: rays, hits (the end), throughputs, ids, path_media, branches
//
// One work-item a slot.

#include "geometry/interaction.cl"
#include "geometry/path_state.cl"
#include "lights/guide.cl"
#include "media/medium_stack.cl"
#include "sampling/branch.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

kernel void sample_indirect(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const DeviceMaterial* restrict materials,
    global const float* restrict surfaces,
    global float* restrict rays,
    global float* restrict hits,
    global float* restrict throughputs,
    global uint* restrict ids,
    global float* restrict path_media,
    global float* restrict branches) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    if (!at_surface(primitive)) return;
    const Vec3 ng = load3(PLANE(surfaces, SURFACE_NG_X), stride, slot);
    const Vec3 n = load_shading_normal(surfaces, stride, slot);
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);

    const uint seed = PLANE(ids, ID_SEED)[slot];
    const uint index = PLANE(ids, ID_INDEX)[slot];
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const Vec3 position = load3(PLANE(surfaces, SURFACE_X), stride, slot);
    const BranchingPath path = {stride, slot, rays, hits, throughputs, path_media, ids, branches};
    const Child child = next_child(&path, params.split_depth, params.splits, position);
    Sample2 u = unit_pair(scattering_pair(seed, index, child.branch, scattering, PAIR_DIRECTION));
    float choice = 0.0f;
    if (HAS_SPECULAR)
        choice = unit_float(scattering_pair(seed, index, child.branch, scattering, PAIR_CHOICE).v);

    const Frame frame = frame_around(n);
    const Surface surface = load_surface(materials, surfaces, stride, slot);
    const Vec3 wo = to_local(frame, scale3(direction, -1.0f));
    Guide guide;
    int guided = 0;
    if (HAS_GUIDE) {
        guide = guide_over(
            guide_at(&params, position, scattering), ng, gltf_diffuse_share(surface, wo),
            surface.base);
        guided = choose_guided(guide, &u);
    }
    BsdfSample s = gltf_sample(surface, wo, u, choice);
    const float side = HAS_TRANSMISSION && s.through ? -1.0f : 1.0f;
    Vec3 wi = to_world(frame, s.wi);
    float pdf_w = s.pdf_w;
    if (HAS_SHADING_NORMALS) {
        wi = select3(side * dot3(ng, wi) < 0.0f, mirror3(wi, ng), wi);
        if (!HAS_GUIDE) {
            const float both = scatter_towards(surface, frame, ng, wo, wi).pdf_w;
            pdf_w = pdf_w == PDF_CERTAIN ? pdf_w : both;
        }
    }
    if (HAS_GUIDE) {
        wi = select3(guided, guide_sample(guide, u), wi);
        const Scattered scattered = scatter_towards(surface, frame, ng, wo, wi);
        const int delta = !guided & (s.pdf_w == PDF_CERTAIN);
        const float mixture = guided_pdf_w(guide, guided, wi, scattered.pdf_w);
        s.weight = select3(
            delta, scale3(s.weight, 1.0f / (1.0f - guide.share)),
            scale3(scattered.value, mixture > 0.0f ? 1.0f / mixture : 0.0f));
        pdf_w = delta ? PDF_CERTAIN : mixture;
        PLANE(hits, HIT_WORTH)[slot] = delta ? 1.0f : guide_worth(mixture, scattered.pdf_w);
    }
    // a direction that is no number makes the throughput none, which accumulate finds
    const float spoilt = 0.0f * (wi.x + wi.y + wi.z);
    const Vec3 weight = vec3(s.weight.x + spoilt, s.weight.y + spoilt, s.weight.z + spoilt);
    Vec3 throughput = mul3(child.carried, weight);
    if (HAS_MEDIA & HAS_CONTACTS & (side < 0.0f)) {
        PLANE(path_media, MEDIUM_STACK)[slot] = PLANE(path_media, CONTACT_MEDIA)[slot];
        throughput = mul3(throughput, load3(PLANE(path_media, CONTACT_R), stride, slot));
    }
    // A direction along the face would leak light through it: it counts as absorbed.
    float goes_on = scattering < params.max_scatterings ? 1.0f : 0.0f;
    goes_on *= (!guided & (side * s.wi.z <= 0.0f)) ? 0.0f : 1.0f;
    goes_on *= side * dot3(ng, wi) <= 0.0f ? 0.0f : 1.0f;
    goes_on *= throughput.x + throughput.y + throughput.z <= 0.0f ? 0.0f : 1.0f;
    const int continues = goes_on > 0.0f;
    set_hit(hits, stride, slot, continues ? primitive : HIT_ENDED);
    store3(PLANE(rays, RAY_ORIGIN_X), stride, slot, leave(position, scale3(ng, side)));
    store3(PLANE(rays, RAY_DIRECTION_X), stride, slot, wi);
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, throughput);
    PLANE(throughputs, THROUGHPUT_PDF)[slot] = pdf_w;
    PLANE(ids, ID_SCATTERING)[slot] = scattering + (continues ? 1 : 0);
    if (HAS_PASSAGES) start_at_origin(path_media, stride, slot);
}
