// Lets paths through index-matched boundaries but for those that `intersect` passed: the ray goes
// on as it is, behind the boundary, tinted by its base colour, in the medium that begins or ends
// there. That is no scattering. At other surfaces: which media the rays that they send back start
// in.
//
// reads: rays, hits, surfaces, throughputs, path_media, triangles, materials
//
// writes: path_media, hits (the pass), throughputs
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "media/medium_stack.cl"
#include "shared/params.h"

// Not inlined: few slots come here, and PoCL would make all of them take part in vectors of gathers
// (18 ns an item in fog, 5 this way).
__attribute__((noinline)) void pass(
    const size_t stride,
    const size_t slot,
    const int primitive,
    global const DeviceMaterial* material,
    global const float* triangles,
    global const float* rays,
    global const float* surfaces,
    global float* path_media,
    global float* hits,
    global float* throughputs) {
    const uint stack = as_uint(PLANE(path_media, MEDIUM_STACK)[slot]);
    global const float* triangle = triangles + TRIANGLE_FLOATS * primitive;
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const uint crossed = cross_boundary(stack, material->medium, triangle, direction);
    const float weight = weight_of_crossing(stack, crossed, material->medium);
    const Vec3 base = load3(PLANE(surfaces, SURFACE_BASE_R), stride, slot);
    const Vec3 throughput =
        scale3(mul3(load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), base), weight);
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, throughput);
    go_on_behind(
        path_media, stride, slot, stack, crossed, PLANE(hits, HIT_T)[slot], primitive,
        touching_distance(triangle, load3(PLANE(surfaces, SURFACE_X), stride, slot), direction));
    set_hit(hits, stride, slot, max_component3(throughput) <= 0.0f ? HIT_ENDED : HIT_BOUNDARY);
}

kernel void pass_boundary(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const float* restrict rays,
    global const float* restrict surfaces,
    global float* restrict path_media,
    global float* restrict hits,
    global float* restrict throughputs) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    if (!at_surface(primitive)) return;
    global const DeviceMaterial* material =
        materials + as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
    if (material->boundary < BOUNDARY_INDEX_MATCHED) {
        // Rays that a surface sends back start ray_offset above it. Where the path passed
        // boundaries closer to it than that, they start before those. A branch vertex that is
        // resumed (at T_RESUMED) has been here before.
        const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
        const Vec3 ng = load3(PLANE(surfaces, SURFACE_NG_X), stride, slot);
        const float offset = ray_offset(load3(PLANE(surfaces, SURFACE_X), stride, slot));
        const float apart = PLANE(hits, HIT_T)[slot] - PLANE(path_media, MEDIUM_T)[slot];
        const int touch =
            (apart >= 0.0f) & (apart * max(fabs(dot3(ng, direction)), LEAST_COSINE) <= offset);
        const int passed = as_int(PLANE(path_media, MEDIUM_PRIMITIVE)[slot]) != NO_BOUNDARY;
        const int sends_back = HAS_CONTACTS | ((material->boundary == BOUNDARY_OPAQUE) &
                                               (material->transmission == 0.0f));
        const float behind = PLANE(path_media, MEDIUM_STACK)[slot];
        if (touch & passed & sends_back)
            PLANE(path_media, MEDIUM_STACK)[slot] = PLANE(path_media, MEDIUM_BEFORE)[slot];
        // a ray that pass_walls lets through goes on in these
        if (HAS_SMOOTH_WALLS & HAS_CONTACTS) PLANE(path_media, MEDIUM_BEFORE)[slot] = behind;
        return;
    }
    pass(
        stride, slot, primitive, material, triangles, rays, surfaces, path_media, hits,
        throughputs);
}
