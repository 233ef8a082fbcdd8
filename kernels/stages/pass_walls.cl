// Lets paths straight through smooth thin walls, with the chance that the wall gives it among all
// that it does with light: the ray goes on as it is, behind the wall. That is no scattering, and
// light sampling has counted no light of it: connections pass such walls, too, and what the path
// meets behind is weighed against them as if the wall were not there. Other paths scatter at the
// wall (sample_indirect).
//
// reads: rays, hits, surfaces, throughputs, path_media, ids, triangles, materials
//
// writes: path_media, hits (the pass), throughputs
//
// One work-item a slot.

#include "geometry/path_state.cl"
#include "media/medium_stack.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"

kernel void pass_walls(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const float* restrict rays,
    global const float* restrict surfaces,
    global const uint* restrict ids,
    global float* restrict path_media,
    global float* restrict hits,
    global float* restrict throughputs) {
    const size_t stride = settings->stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    if (!at_surface(primitive)) return;
    if (is_resumed(hits, stride, slot)) return;  // it has not been passed
    const float t = PLANE(hits, HIT_T)[slot];
    global const DeviceMaterial* material =
        materials + as_int(PLANE(surfaces, SURFACE_MATERIAL)[slot]);
    if (material->boundary != BOUNDARY_OPAQUE) return;
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const Surface surface = load_surface(materials, surfaces, stride, slot);
    const float cosine = -dot3(load_shading_normal(surfaces, stride, slot), direction);
    const Vec3 straight = gltf_straight_through(surface, cosine);
    const float through = max_component3(straight);
    if (through <= 0.0f) return;
    const Reflectance scattered = lobe_albedos(surface, cosine);
    const float base = max_component3(surface.base);
    const float pmf = through / (through + max_component3(scattered.specular) +
                                 base * (scattered.diffuse + scattered.spread));

    // every wall on a ray draws a number of its own
    const uint passes = as_uint(PLANE(path_media, MEDIUM_PASSES)[slot]);
    const Bits2 choice = scattering_pair(
        hash_pair(PLANE(ids, ID_SEED)[slot], passes + 1), PLANE(ids, ID_INDEX)[slot],
        HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0, PLANE(ids, ID_SCATTERING)[slot], PAIR_CHOICE);
    const int is_passed = unit_float(choice.u) < pmf;
    const float rest = 1.0f / (1.0f - pmf);
    const Vec3 weight = select3(is_passed, scale3(straight, 1.0f / pmf), vec3(rest, rest, rest));
    store3(
        PLANE(throughputs, THROUGHPUT_R), stride, slot,
        mul3(load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), weight));
    if (!is_passed) return;
    // pass_boundary has kept the media behind the boundaries that touch the wall
    const int kept = HAS_MEDIA & HAS_CONTACTS;
    const uint before = as_uint(PLANE(path_media, MEDIUM_STACK)[slot]);
    const uint stack = kept ? as_uint(PLANE(path_media, MEDIUM_BEFORE)[slot]) : before;
    go_on_behind(
        path_media, stride, slot, before, stack, t, primitive,
        touching_distance(
            triangles + (size_t)TRIANGLE_FLOATS * primitive,
            load3(PLANE(surfaces, SURFACE_X), stride, slot), direction));
    if (kept) PLANE(path_media, MEDIUM_BEFORE)[slot] = as_float(before);
    set_hit(hits, stride, slot, HIT_BOUNDARY);
}
