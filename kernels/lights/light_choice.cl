// Choosing one entry of a discrete distribution: Walker's alias method with integer bits [Walker
// 1974; Vose 1991].
#pragma once

#include "sampling/sobol.cl"
#include "shared/inline.h"
#include "shared/scene.h"

// Splits 32 random bits into an entry of `count` and fresh bits for the threshold.
INLINE uint choice_entry(const uint bits, const uint count) {
    return mul_hi(bits, count);
}

INLINE uint choice_rest(const uint bits, const uint count) {
    // the hash fills the gaps of the lattice that the product lies on
    return bits * count + mul_hi(hash_uint(bits), count);
}

INLINE uint choose_light(global const DeviceLight* lights, const uint count, const uint bits) {
    const uint entry = choice_entry(bits, count);
    const int keep = unit_float(choice_rest(bits, count)) < lights[(int)entry].alias_threshold;
    return keep ? entry : lights[(int)entry].alias;
}
