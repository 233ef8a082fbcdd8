// Which random numbers a decision takes: a pair of dimensions for each, SCATTERING_PAIRS a
// scattering.
#pragma once

#include "sampling/sobol.cl"
#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/inline.h"
#include "shared/path.h"

#define PAIR_PIXEL 0u  // position within the pixel
#define PAIR_FIRST 1u  // of the first scattering

#define PAIR_LIGHT_POINT 0u  // point on the light
#define PAIR_DIRECTION 1u    // direction of the next ray
#define PAIR_CHOICE 2u       // which light, which lobe
#define PAIR_ROULETTE 3u     // survival (first of the pair)
#define PAIR_DISTANCE 4u     // distance in a medium, colour channel it is drawn for
#define SCATTERING_PAIRS (4u + HAS_MEDIA)

// Beyond these scatterings points are independent: stratification over so many dimensions buys
// nothing.
#define SOBOL_SCATTERINGS 8u

// `seed` and `reversed_index`: planes ID_SEED and ID_INDEX.
INLINE Bits2
dimension_pair(const uint seed, const uint reversed_index, const uint dimension, const int low) {
    const uint pair_seed = hash_pair(seed, dimension);
    if (!SAMPLER_SOBOL) return independent_pair(reversed_index, pair_seed);
    const Bits2 sobol = sobol_pair(reversed_index, pair_seed);
    const Bits2 tail = independent_pair(reversed_index, pair_seed);
    Bits2 b;
    b.u = low ? sobol.u : tail.u;
    b.v = low ? sobol.v : tail.v;
    return b;
}

// `branch`: plane ID_BRANCH, so that the children of a branch vertex differ.
INLINE Bits2 scattering_pair(
    const uint seed,
    const uint reversed_index,
    const uint branch,
    const uint scattering,
    const uint pair) {
    const uint dimension = PAIR_FIRST + scattering * SCATTERING_PAIRS + pair;
    return dimension_pair(
        seed, reversed_index, HAS_SPLITS ? hash_pair(dimension, branch) : dimension,
        scattering < SOBOL_SCATTERINGS);
}

// Random bits of slot `slot`'s ray, by which surfaces that cover a part of a point stop it or not
// (geometry/surface_texture.cl).
INLINE uint cover_key(global const uint* ids, const size_t stride, const size_t slot) {
    const uint dimension = PAIR_FIRST + PLANE(ids, ID_SCATTERING)[slot] * SCATTERING_PAIRS;
    const uint branch = HAS_SPLITS ? PLANE(ids, ID_BRANCH)[slot] : 0;
    const uint ray = hash_pair(PLANE(ids, ID_SEED)[slot], PLANE(ids, ID_INDEX)[slot]);
    return hash_pair(ray, hash_pair(dimension, branch));
}

// Random bits of slot `slot`'s ray, by which it meets boundaries that transmit in part or not
// (media/boundary_share.cl). Its direction takes the place of its branch, which `sample_distance`
// changes between the stages that ask.
INLINE uint share_key(
    global const uint* ids, global const float* rays, const size_t stride, const size_t slot) {
    const uint ray = hash_pair(PLANE(ids, ID_SEED)[slot], PLANE(ids, ID_INDEX)[slot]);
    const uint x = as_uint(PLANE(rays, RAY_DIRECTION_X)[slot]);
    const uint y = as_uint(PLANE(rays, RAY_DIRECTION_Y)[slot]);
    const uint z = as_uint(PLANE(rays, RAY_DIRECTION_Z)[slot]);
    return hash_pair(
        hash_pair(ray, PLANE(ids, ID_SCATTERING)[slot]), hash_pair(x, hash_pair(y, z)));
}

// The same as cover_key for its connection to a light.
INLINE uint shadow_cover_key(global const uint* ids, const size_t stride, const size_t slot) {
    return ~cover_key(ids, stride, slot);
}
