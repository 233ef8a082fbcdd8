// Owen-scrambled Sobol points, two dimensions at a time, each pair with its own shuffle of the
// sequence (Burley 2020, "Practical hash-based Owen scrambling"), in straight-line integer code.
#pragma once

#include "sampling/rng.cl"
#include "shared/inline.h"

INLINE uint reverse_bits_32(uint x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

// A permutation in which every bit depends on lower bits alone: an Owen scramble of the
// bit-reversed word (Laine & Karras 2011; constants of Vegdahl 2021).
INLINE uint scramble_upwards(uint x, const uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Second Sobol dimension of `index`, bits reversed: bit j is the parity of the index bits k that
// contain j, since its generator matrix is Pascal's triangle modulo 2 (Sobol 1967; Lucas' theorem).
INLINE uint sobol_second(uint x) {
    x ^= (x >> 1) & 0x55555555u;
    x ^= (x >> 2) & 0x33333333u;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 8) & 0x00ff00ffu;
    x ^= x >> 16;
    return x;
}

typedef struct {
    uint u, v;  // 32 random bits each, best ones first
} Bits2;

typedef struct {
    float u, v;  // [0, 1)
} Sample2;

INLINE Sample2 unit_pair(const Bits2 bits) {
    Sample2 s;
    s.u = unit_float(bits.u);
    s.v = unit_float(bits.v);
    return s;
}

// Point `reversed_index` (bits reversed) of the pair of dimensions that `seed` names.
INLINE Bits2 sobol_pair(const uint reversed_index, const uint seed) {
    const uint shuffled = reverse_bits_32(scramble_upwards(reversed_index, hash_uint(seed)));
    Bits2 b;
    b.u = reverse_bits_32(scramble_upwards(shuffled, hash_uint(seed ^ 0x68bc21ebu)));
    b.v = reverse_bits_32(scramble_upwards(sobol_second(shuffled), hash_uint(seed ^ 0x02e5be93u)));
    return b;
}

INLINE Bits2 independent_pair(const uint reversed_index, const uint seed) {
    const uint h = hash_uint(reversed_index ^ seed);
    Bits2 b;
    b.u = hash_uint(h ^ 0x68bc21ebu);
    b.v = hash_uint(h ^ 0x02e5be93u);
    return b;
}
