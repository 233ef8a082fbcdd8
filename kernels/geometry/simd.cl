// What OpenCL C 1.2 has no words for and what decides the speed of a traversal on a CPU: which
// lanes of a comparison hold, the lanes of a set packed together, fetching ahead. Where a compiler
// has the one instruction for it, that stands before the portable text.
#pragma once

#include "shared/inline.h"

#ifndef __has_builtin
#define __has_builtin(name) 0
#endif

// Bit k: lane k of a comparison (-1 or 0) holds.
INLINE uint lane_mask(const int8 lanes) {
#if defined(__AVX__) && __has_builtin(__builtin_ia32_movmskps256)
    return (uint)__builtin_ia32_movmskps256(as_float8(lanes));
#else
    const int8 bits = lanes & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 quarter = bits.lo | bits.hi;
    int pair[2];  // not .x and .y: oclgrind --uninitialized crashes where one lane is read
    vstore2(quarter.lo | quarter.hi, 0, pair);
    return (uint)(pair[0] | pair[1]);
#endif
}

// The least of eight.
INLINE int least_lane(const int8 x) {
    const int4 quarter = min(x.lo, x.hi);
    int pair[2];
    vstore2(min(quarter.lo, quarter.hi), 0, pair);
    return min(pair[0], pair[1]);
}

// The lanes whose bits are set, in order, from lane 0 on; what the others hold is undefined.
// (pext is microcode on the first two Zens, and slower there than the loop.)
#if defined(__AVX2__) && defined(__BMI2__) && !defined(__znver1__) && !defined(__znver2__) && \
    __has_builtin(__builtin_ia32_permvarsi256)
INLINE int8 pack_lanes(const int8 x, const uint lanes) {
    // A byte of ones for each set bit picks the lane numbers, which pext moves together.
    const ulong bytes = __builtin_ia32_pdep_di(lanes, 0x0101010101010101ul) * 255ul;
    const ulong order = __builtin_ia32_pext_di(0x0706050403020100ul, bytes);
    return __builtin_ia32_permvarsi256(x, convert_int8(as_uchar8(order)));
}
#else
INLINE int8 pack_lanes(const int8 x, const uint lanes) {
    int from[8];
    int to[8];
    vstore8(x, 0, from);
    vstore8(x, 0, to);
    int count = 0;
    for (int k = 0; k < 8; ++k) {
        to[count] = from[k];
        count += (int)(lanes >> k & 1u);
    }
    return vload8(0, to);
}
#endif

// Asks for the 64 bytes at `address + offset`; any address may be given.
#if defined(__AVX__) && __has_builtin(__builtin_prefetch)
#define PREFETCH_LINE(address, offset) __builtin_prefetch((const void*)((address) + (offset)))
#else
#define PREFETCH_LINE(address, offset) ((void)(address))
#endif
