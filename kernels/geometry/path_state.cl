// What a slot's hit says of its path: the words for the codes of HIT_PRIMITIVE and the signs of
// HIT_T, whose table stands in shared/path.h.
#pragma once

#include "sampling/vector.cl"
#include "shared/features.h"
#include "shared/path.h"

// A triangle, or one of HIT_MISS, HIT_ENDED, ...
INLINE int hit_of(global const float* hits, const size_t stride, const size_t slot) {
    return as_int(PLANE(hits, HIT_PRIMITIVE)[slot]);
}

INLINE void set_hit(global float* hits, const size_t stride, const size_t slot, const int hit) {
    PLANE(hits, HIT_PRIMITIVE)[slot] = as_float(hit);
}

INLINE int at_surface(const int hit) {
    return hit >= 0;
}

// Whether the path is back at a branch vertex, which was shaded before, to leave it in another
// direction.
INLINE int is_resumed(global const float* hits, const size_t stride, const size_t slot) {
    return HAS_SPLITS && PLANE(hits, HIT_T)[slot] == T_RESUMED;
}

// Whether the segment was traced before: the path is back at its end, or is to stop on it.
INLINE int is_traced(global const float* hits, const size_t stride, const size_t slot) {
    return HAS_SPLITS && PLANE(hits, HIT_T)[slot] < 0.0f;
}
