// What the arithmetic gives: fused multiply-adds in chains that do not wait for one another, as
// many as it takes to hide an instruction's latency. 2 * WIDTH * FMA_CHAINS * FMA_STEPS operations
// an item.
//
// One work-item for FMA_CHAINS vectors of WIDTH floats.

#include "shared/peaks.h"

#ifndef WIDTH
#define WIDTH 8  // 1, 4, 8 or 16
#endif

#define JOIN_NAMES(a, b) a##b
#define VECTOR_OF(width) JOIN_NAMES(float, width)
#if WIDTH == 1
typedef float Lanes;
#else
typedef VECTOR_OF(WIDTH) Lanes;
#endif

kernel void fma_chains(const float factor, const float addend, global Lanes* restrict sums) {
    const size_t i = get_global_id(0);
    const Lanes f = factor;
    const Lanes a = addend;
    Lanes x0 = (float)i, x1 = x0 + a, x2 = x1 + a, x3 = x2 + a;
    Lanes x4 = x3 + a, x5 = x4 + a, x6 = x5 + a, x7 = x6 + a;
    for (int step = 0; step < FMA_STEPS; ++step) {
        x0 = fma(x0, f, a);
        x1 = fma(x1, f, a);
        x2 = fma(x2, f, a);
        x3 = fma(x3, f, a);
        x4 = fma(x4, f, a);
        x5 = fma(x5, f, a);
        x6 = fma(x6, f, a);
        x7 = fma(x7, f, a);
    }
    sums[i] = max(max(max(x0, x1), max(x2, x3)), max(max(x4, x5), max(x6, x7)));
}
