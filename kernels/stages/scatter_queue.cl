// Pairs the slots to be emptied with those to be filled, both in order, so that `kept` slots
// hold all the work: idle slots below `kept`, a multiple of QUEUE_CHUNK, with live ones above
// it.
//
// reads: hits, chunks
//
// writes: holes, movers
//
// One work-item a chunk.

#include "geometry/path_state.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void scatter_queue(
    constant const RenderParams* restrict settings,
    const uint slots,
    const uint kept,
    global const float* restrict hits,
    global const ChunkState* restrict chunks,
    global uint* restrict holes,
    global uint* restrict movers) {
    const size_t stride = settings->stride;
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * QUEUE_CHUNK;
    if (first >= slots) return;
    const uint last = min(first + QUEUE_CHUNK, slots);
    const int below = first < kept;
    uint at = below ? 0 : 1;  // movers[0] counts them
    for (uint c = below ? 0 : kept / QUEUE_CHUNK; c < chunk; ++c)
        at += below ? QUEUE_CHUNK - chunks[c].active : chunks[c].active;
    global uint* list = below ? holes : movers;
    for (uint slot = first; slot < last; ++slot) {
        const int idle = hit_of(hits, stride, slot) == HIT_IDLE;
        if (idle == below) list[at++] = slot;
    }
    if (last == slots) movers[0] = below ? 0 : at - 1;
}
