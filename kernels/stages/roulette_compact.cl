// Decides which paths go on (notes 4, Russian roulette: survivors carry 1/q) and what becomes
// of each slot.
//
// reads: ids, hits, throughputs, path_media, fates, media
//
// writes: throughputs, hits (the end), ids (scatterings of the last ray traced), fates
//
// One work-item a slot. scan_queue counts the fates.

#include "geometry/path_state.cl"
#include "media/medium_stack.cl"
#include "sampling/dimensions.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

// Paths that carry more are all kept: 1/3 was best or within 5 % of it, in variance times rays, on
// Cornell box, close light, plates and terrain (docs/measurements/2026-11-22-noise.md).
#define ROULETTE_BELOW (1.0f / 3.0f)

// What loses nothing at surfaces goes on by chance from some length on, so that it ends. Lower
// bounds or earlier ones have endless variance where light takes long to get out: .99 from 256 on
// loses .6 % of a white room with a window of .7 %, .95 from 64 on a quarter. In media light always
// gets out, and may take long.
#define LONG_PATH 1000u  // scatterings
#define LONG_PATH_SURVIVAL 0.999f

// Tested on the bits: a compiler may assume that x == x.
INLINE int is_nan_bits(const float x) {
    return (as_uint(x) & 0x7fffffffu) > 0x7f800000u;
}

kernel void roulette_compact(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const DeviceMedium* restrict media,
    global const float* restrict path_media,
    global uint* restrict ids,
    global float* restrict hits,
    global float* restrict throughputs,
    global uchar* restrict fates) {
    const RenderParams params = *settings;
    const size_t stride = params.stride;
    const size_t slot = get_global_id(0);
    if (slot >= slots) return;
    const int primitive = hit_of(hits, stride, slot);
    if (primitive == HIT_IDLE) {
        fates[slot] = 0;
        return;
    }
    const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
    const Vec3 throughput = load3(PLANE(throughputs, THROUGHPUT_R), stride, slot);

    // q: constant, or what the path still carries against ROULETTE_BELOW; never above 1
    float survival = 1.0f;
    // a child carries a part of its parent, which says nothing about its worth
    const float shares = HAS_SPLITS ? as_float(PLANE(ids, ID_SHARES)[slot]) : 1.0f;
    const float worth = HAS_GUIDE ? PLANE(hits, HIT_WORTH)[slot] : 1.0f;
    float carried = max_component3(throughput) * shares * worth;
    if (HAS_DIELECTRICS) {
        // a path into glass carries 1 / n^2 of the n^2 times brighter radiance there, and is worth
        // as much as before
        const float ior = refractive_index(media, as_uint(PLANE(path_media, MEDIUM_STACK)[slot]));
        carried *= ior * ior;
    }
    const int is_long = (scattering >= LONG_PATH) & (primitive != HIT_MEDIUM);
    const float most = is_long ? LONG_PATH_SURVIVAL : 1.0f;
    survival = params.roulette == 1 ? min(most, carried * (1.0f / ROULETTE_BELOW)) : survival;
    survival = params.roulette == 2 ? params.survival : survival;
    // once a scattering, not once a boundary
    if (HAS_PASSAGES) survival = primitive == HIT_BOUNDARY ? 1.0f : survival;
    const uint branch = HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0;
    const uint dimension = PAIR_FIRST + scattering * SCATTERING_PAIRS + PAIR_ROULETTE;
    // chosen, because LLVM 18's SLP pass joins this hash with that of the index: nothing is
    // vectorised
    const uint seed =
        params.roulette == 0
            ? 0u
            : hash_pair(
                  PLANE(ids, ID_SEED)[slot], HAS_SPLITS ? hash_pair(dimension, branch) : dimension);
    const float u = unit_float(hash_pair(seed, PLANE(ids, ID_INDEX)[slot]));
    const int done =
        HAS_PASSAGES ? (primitive == HIT_MISS) | (primitive == HIT_ENDED) : !at_surface(primitive);
    // nothing makes a NaN throughput a number again: its path is over, and accumulate counts it
    const int over = done | is_nan_bits(throughput.x + throughput.y + throughput.z);
    const int dies = !over && u >= survival;
    const int ends = over || dies;
    store3(
        PLANE(throughputs, THROUGHPUT_R), stride, slot,
        scale3(throughput, ends ? 1.0f : 1.0f / survival));
    set_hit(hits, stride, slot, ends ? HIT_ENDED : primitive);
    PLANE(ids, ID_SCATTERING)[slot] = scattering - (dies ? 1 : 0);

    const int has_next =
        PLANE(ids, ID_LEFT)[slot] > 0 || PLANE(ids, ID_CELL)[slot] + params.pool < params.cells;
    const uint connected = SAMPLE_LIGHTS ? fates[slot] : 0u;
    const int is_cut = (primitive == HIT_ENDED) & (scattering >= MAX_SCATTERINGS);
    fates[slot] =
        (uchar)(connected | (!ends || has_next ? FATE_ACTIVE : 0u) | (ends ? FATE_ENDED : 0u) | (is_cut ? FATE_CUT : 0u));
}
