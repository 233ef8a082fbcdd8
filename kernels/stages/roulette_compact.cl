// Decides which paths go on (notes 4, Russian roulette: survivors carry 1/q) and what becomes of each slot.
// reads: queue, plan    writes: throughputs, hits (the end), ids (scatterings of the last ray traced), fates
// One work-item an active path. scan_queue and scatter_queue turn the fates into the next queues.

#include "sampling/dimensions.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void roulette_compact(
    constant const RenderParams* restrict params,
    global const QueueSizes* restrict sizes,
    global const uint* restrict queue,
    global const PlanRow* restrict plan,
    global uint* restrict ids,
    global float* restrict hits,
    global float* restrict throughputs,
    global uchar* restrict fates) {
    const uint i = (uint)get_global_id(0);
    if (i >= sizes->active) return;
    const int slot = (int)queue[i];
    const int stride = (int)params->stride;
    const int primitive = as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const Vec3 throughput = load3(PLANE(throughputs, THROUGHPUT_R), stride, slot);

    // q: constant, or what the path still carries; never above 1
    float survival = 1.0f;
    survival = params->roulette == 1 ? min(1.0f, max_component3(throughput)) : survival;
    survival = params->roulette == 2 ? params->survival : survival;
    const uint branch = HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0;
    const uint dimension = PAIR_FIRST + scattering * SCATTERING_PAIRS + PAIR_ROULETTE;
    const uint seed = hash_pair(PLANE(ids, ID_SEED)[slot], HAS_SPLITS ? hash_pair(dimension, branch) : dimension);
    const float u = unit_float(hash_pair(seed, PLANE(ids, ID_INDEX)[slot]));
    // a NaN throughput survives, to be found and counted at the end of the path
    const int dies = primitive >= 0 && u >= survival;
    const int ends = primitive < 0 || dies;
    store3(PLANE(throughputs, THROUGHPUT_R), stride, slot, scale3(throughput, 1.0f / survival));
    PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(ends ? HIT_ENDED : primitive);
    PLANE(ids, ID_SCATTERING)[slot] = scattering - (dies ? 1 : 0);

    const uint pass = PLANE(ids, ID_PASS)[slot];
    const int has_next = PLANE(ids, ID_SAMPLE)[slot] + 1 < plan[(int)pass].samples ||
                         PLANE(ids, ID_CELL)[slot] + params->pool < params->cells;
    const uint connected = SAMPLE_LIGHTS ? fates[i] : 0u;
    fates[i] = (uchar)(connected | (!ends || has_next ? FATE_ACTIVE : 0u) | (ends ? FATE_ENDED : 0u));
}
