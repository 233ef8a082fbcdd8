// Writes the next active queue and the queue of ended paths, both in the order of this one, and their sizes; counts
// the ended paths by length, and the connections.
// reads: queue, fates, chunk_counts, ids    writes: next_active, ended, next_sizes, statistics (a row each chunk)
// One work-item a chunk of QUEUE_CHUNK entries.

#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void scatter_queue(
    constant const RenderParams* restrict params,
    global const QueueSizes* restrict sizes,
    global const uint* restrict queue,
    global const uchar* restrict fates,
    global const uint2* restrict chunk_counts,
    global const uint* restrict ids,
    global uint* restrict next_active,
    global uint* restrict ended,
    global QueueSizes* restrict next_sizes,
    global uint* restrict statistics) {
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * QUEUE_CHUNK;
    if (first >= sizes->active) return;
    const uint last = min(first + QUEUE_CHUNK, sizes->active);
    global uint* row = statistics + chunk * STATISTICS;
    uint connections = 0;
    uint2 at = (uint2)(0, 0);
    for (uint c = 0; c < chunk; ++c) at += chunk_counts[c];
    for (uint i = first; i < last; ++i) {
        const uint slot = queue[i];
        const uint fate = fates[i];
        connections += fate / FATE_CONNECTED;
        if (fate & FATE_ACTIVE) next_active[at.x++] = slot;
        if (!(fate & FATE_ENDED)) continue;
        ended[at.y++] = slot;
        const uint scattering = PLANE(ids, ID_SCATTERING)[slot];
        row[min(scattering, DEPTH_BINS - 1u)] += 1;
        // The first to find a runaway path names it; the other writers are the work-items of other chunks.
        if (scattering >= MAX_SCATTERINGS && atomic_cmpxchg(&next_sizes->runaway_lock, 0u, 1u) == 0) {
            next_sizes->runaway_pixel = PLANE(ids, ID_PIXEL)[slot];
            next_sizes->runaway_pass = PLANE(ids, ID_PASS)[slot];
            next_sizes->runaway_sample = PLANE(ids, ID_SAMPLE)[slot];
        }
    }
    row[DEPTH_BINS] += connections;
    if (last == sizes->active) {
        next_sizes->active = at.x;
        next_sizes->ended = at.y;
    }
}
