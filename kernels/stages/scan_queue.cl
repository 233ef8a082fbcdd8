// Counts the fates of each chunk of QUEUE_CHUNK queue entries.
// reads: fates    writes: chunk_counts (x: active, y: ended)
// One work-item a chunk.

#include "shared/queues.h"

kernel void scan_queue(
    global const QueueSizes* restrict sizes,
    global const uchar* restrict fates,
    global uint2* restrict chunk_counts) {
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * QUEUE_CHUNK;
    if (first >= sizes->active) return;
    const uint last = min(first + QUEUE_CHUNK, sizes->active);
    uint active = 0;
    uint ended = 0;
    for (uint i = first; i < last; ++i) {
        active += fates[i] & FATE_ACTIVE;
        ended += (fates[i] & FATE_ENDED) >> 1;
    }
    chunk_counts[chunk] = (uint2)(active, ended);
}
