// Connections to lights that wait to be traced (the planes of `shadows`, shared/path.h).
#pragma once

#include "sampling/vector.cl"
#include "shared/inline.h"
#include "shared/path.h"
#include "shared/queues.h"

// Where the slot's connection ends; 0 or less: there is none. Its fate says which.
INLINE float open_connection(
    global const float* shadows, global uchar* fates, const size_t stride, const size_t slot) {
    const float t_max = PLANE(shadows, SHADOW_T_MAX)[slot];
    fates[slot] = t_max > 0.0f ? FATE_CONNECTED : 0u;
    return t_max;
}
