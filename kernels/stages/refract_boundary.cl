// Continues every path at a dielectric boundary: reflected with the chance that Fresnel's equations
// give, else refracted into the medium that begins or ends there. A path that crosses carries
// (n_i / n_t)^2 of the radiance behind [Veach 1997, section 5.2].
//
// reads: rays, hits, surfaces, throughputs, path_media, ids, triangles, materials, media
//
// writes: rays, hits, path_media, throughputs, ids
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "materials/dielectric.cl"
#include "media/medium_stack.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

kernel void refract_boundary(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const DeviceMedium* restrict media,
    global const float* restrict surfaces,
    global float* restrict rays,
    global float* restrict path_media,
    global float* restrict hits,
    global float* restrict throughputs,
    global uint* restrict ids) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    if (!at_surface(primitive)) return;
    global const DeviceMaterial* material =
        materials + as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
    if (material->boundary != BOUNDARY_DIELECTRIC) return;
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const Vec3 ng = load3(PLANE(surfaces, SURFACE_NG_X), stride, slot);
    const uint stack = as_uint(PLANE(path_media, MEDIUM_STACK)[slot]);
    uint crossed;
    Vec3 passed = load3(PLANE(surfaces, SURFACE_BASE_R), stride, slot);
    if (HAS_CONTACTS) {
        crossed = as_uint(PLANE(path_media, CONTACT_MEDIA)[slot]);
        passed = mul3(passed, load3(PLANE(path_media, CONTACT_R), stride, slot));
    } else {
        crossed = cross_boundary(
            stack, material->medium, triangles + TRIANGLE_FLOATS * primitive, direction);
        passed = scale3(passed, weight_of_crossing(stack, crossed, material->medium));
    }

    const uint seed = PLANE(ids, ID_SEED)[slot];
    const uint index = PLANE(ids, ID_INDEX)[slot];
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const uint branch = HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0;
    const Sample2 u = unit_pair(scattering_pair(seed, index, branch, scattering, PAIR_DIRECTION));
    const float choice =
        unit_float(scattering_pair(seed, index, branch, scattering, PAIR_CHOICE).v);
    const Vec3 viewer = scale3(direction, -1.0f);
    const float ior_i = refractive_index(media, stack);
    const float ior_t = refractive_index(media, crossed);
    const float alpha = HAS_LOBE_TEXTURES ? PLANE(surfaces, SURFACE_ALPHA)[slot] : material->alpha;
    Vec3 n = load_shading_normal(surfaces, stride, slot);
    if (HAS_SHADING_NORMALS) n = interface_normal(n, ng, viewer, ior_i, ior_t, scattering);
    const Frame frame = frame_around(n);
    const Vec3 wo = to_local(frame, viewer);
    const DielectricSample s = dielectric_sample(wo, alpha, ior_i, ior_t, u, choice);
    const Vec3 side = scale3(ng, s.reflects ? 1.0f : -1.0f);
    Vec3 wi = to_world(frame, s.wi);
    float pdf_w = s.pdf_w;
    if (HAS_SHADING_NORMALS) {
        wi = select3(dot3(side, wi) < 0.0f, mirror3(wi, ng), wi);
        if (ROUGH_DIELECTRICS && pdf_w != PDF_CERTAIN)
            pdf_w = dielectric_towards(frame, ng, wo, wi, alpha, ior_i, ior_t).pdf_w;
    }

    const Vec3 one = vec3(1.0f, 1.0f, 1.0f);
    const Vec3 throughput = mul3(
        load3(PLANE(throughputs, THROUGHPUT_R), stride, slot),
        scale3(select3(s.reflects, one, passed), s.weight));
    float goes_on = scattering < params.max_scatterings ? 1.0f : 0.0f;
    goes_on *= dot3(side, wi) <= 0.0f ? 0.0f : 1.0f;
    goes_on *= throughput.x + throughput.y + throughput.z <= 0.0f ? 0.0f : 1.0f;  // not NaN
    const int continues = goes_on > 0.0f;
    set_hit(hits, stride, slot, continues ? HIT_DIELECTRIC : HIT_ENDED);
    const Vec3 position = load3(PLANE(surfaces, SURFACE_X), stride, slot);
    store3(PLANE(rays, RAY_ORIGIN_X), stride, slot, leave(position, side));
    store3(PLANE(rays, RAY_DIRECTION_X), stride, slot, wi);
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, throughput);
    PLANE(throughputs, THROUGHPUT_PDF)[slot] = pdf_w;
    PLANE(path_media, MEDIUM_STACK)[slot] = as_float(s.reflects ? stack : crossed);
    PLANE(ids, ID_SCATTERING)[slot] = scattering + (continues ? 1 : 0);
    if (HAS_GUIDE) PLANE(hits, HIT_WORTH)[slot] = 1.0f;
    start_at_origin(path_media, stride, slot);
    // what `leave` skipped lies in the medium too, and matters to a dense one; a grazing ray may
    // have left its curved surface before that
    PLANE(path_media, MEDIUM_T)[slot] = -ray_offset(position) / max(dot3(side, wi), LEAST_COSINE);
}
