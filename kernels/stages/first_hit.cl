// Records what the camera saw first: albedo, shading normal, distance.
// reads: queue of the samples just started, rays, hits, scene    writes: sums
// One work-item a started sample.

#include "geometry/interaction.cl"
#include "shared/params.h"
#include "shared/queues.h"

kernel void first_hit(
    constant const RenderParams* restrict params,
    global const QueueSizes* restrict sizes,
    global const uint* restrict started,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global const float* restrict rays,
    global const float* restrict hits,
    global float* restrict radiances) {
    const uint i = (uint)get_global_id(0);
    if (i >= sizes->ended) return;
    const int slot = (int)started[i];
    const int stride = (int)params->stride;
    const int primitive = as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
    const Interaction x = interact(
        triangles, materials, primitive, PLANE(hits, HIT_U)[slot], PLANE(hits, HIT_V)[slot],
        load3(PLANE(rays, RAY_DIRECTION_X), stride, slot));
    const int hit = primitive >= 0;
    const Vec3 zero = vec3(0.0f, 0.0f, 0.0f);
    global float* albedo = PLANE(radiances, SUM_ALBEDO_R);
    global float* normal = PLANE(radiances, SUM_NORMAL_X);
    store3(albedo, stride, slot, add3(load3(albedo, stride, slot), select3(hit, x.surface.base, zero)));
    store3(normal, stride, slot, add3(load3(normal, stride, slot), select3(hit, x.n, zero)));
    PLANE(radiances, SUM_DEPTH)[slot] += hit ? PLANE(hits, HIT_T)[slot] * params->metres : 0.0f;
    PLANE(radiances, SUM_COVERAGE)[slot] += hit ? 1.0f : 0.0f;
}
