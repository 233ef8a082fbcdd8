// Randomness without state: a hash of (seed, pixel, sample, dimension).
#pragma once

#include "shared/inline.h"

// Integer hash of low bias (Wellons 2018, "lowbias32").
INLINE uint hash_uint(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

INLINE uint hash_pair(const uint a, const uint b) {
    return hash_uint(a ^ hash_uint(b + 0x9e3779b9u));
}

// [0, 1): the top 24 bits, since 32 would round up to 1 in a float.
INLINE float unit_float(const uint x) {
    return (float)(x >> 8) * 0x1p-24f;
}
