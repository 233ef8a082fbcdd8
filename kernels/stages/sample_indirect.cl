// Continues every path at a surface in a direction of its bsdf (notes 3 and 5, indirectRadianceEstimator), or ends it.
// reads: queue, ids, scene    writes: rays, hits (the end), throughputs, ids
// One work-item an active path.

#include "geometry/interaction.cl"
#include "sampling/dimensions.cl"
#include "shared/params.h"
#include "shared/queues.h"

kernel void sample_indirect(
    constant const RenderParams* restrict params,
    global const QueueSizes* restrict sizes,
    global const uint* restrict queue,
    global const float* restrict triangles,
    global const DeviceMaterial* restrict materials,
    global float* restrict rays,
    global float* restrict hits,
    global float* restrict throughputs,
    global uint* restrict ids) {
    const uint i = (uint)get_global_id(0);
    if (i >= sizes->active) return;
    const int slot = (int)queue[i];
    const int stride = (int)params->stride;
    const int primitive = as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
    const Vec3 direction = load3(PLANE(rays, RAY_DIRECTION_X), stride, slot);
    const Interaction x = interact(
        triangles, materials, primitive, PLANE(hits, HIT_U)[slot], PLANE(hits, HIT_V)[slot], direction);

    const uint seed = PLANE(ids, ID_SEED)[slot];
    const uint index = PLANE(ids, ID_INDEX)[slot];
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const uint branch = HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0;
    const Sample2 u = unit_pair(scattering_pair(seed, index, branch, scattering, PAIR_DIRECTION));
    float choice = 0.0f;
    if (HAS_SPECULAR) choice = unit_float(scattering_pair(seed, index, branch, scattering, PAIR_CHOICE).v);

    const Frame frame = frame_around(x.n);
    const BsdfSample s = gltf_sample(x.surface, to_local(frame, scale3(direction, -1.0f)), u, choice);
    const Vec3 wi = to_world(frame, s.wi);
    const Vec3 throughput = mul3(load3(PLANE(throughputs, THROUGHPUT_R), stride, slot), s.weight);
    // A direction on the far side of the face would leak light through it: it counts as absorbed.
    const int continues = primitive >= 0 && scattering < params->max_scatterings && s.wi.z > 0.0f &&
                          dot3(x.ng, wi) > 0.0f && !(max_component3(throughput) <= 0.0f);
    PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(continues ? primitive : HIT_ENDED);
    store3(PLANE(rays, RAY_ORIGIN_X), stride, slot, leave(x.p, x.ng));
    store3(PLANE(rays, RAY_DIRECTION_X), stride, slot, wi);
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, throughput);
    PLANE(throughputs, THROUGHPUT_PDF)[slot] = s.pdf_w;
    PLANE(ids, ID_SCATTERING)[slot] = scattering + (continues ? 1 : 0);
}
