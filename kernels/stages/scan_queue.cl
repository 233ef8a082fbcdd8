// Counts each chunk of QUEUE_CHUNK slots: those with work, the ended paths by length, the
// connections.
//
// reads: fates, ids, statistics
//
// writes: chunks, statistics (a row each chunk)
//
// One work-item a chunk.

#include "sampling/sobol.cl"
#include "sampling/vector.cl"
#include "shared/params.h"
#include "shared/path.h"
#include "shared/queues.h"

kernel void scan_queue(
    constant const RenderParams* restrict settings,
    const uint slots,
    global const uchar* restrict fates,
    global const uint* restrict ids,
    global ChunkState* restrict chunks,
    global uint* restrict statistics) {
    const size_t stride = settings->stride;
    const uint chunk = (uint)get_global_id(0);
    const uint first = chunk * QUEUE_CHUNK;
    if (first >= slots) return;
    const uint last = min(first + QUEUE_CHUNK, slots);
    global uint* row = statistics + chunk * STATISTICS;
    uint active = 0;
    uint resumed = 0;
    uint connections = 0;
    uint cut = 0;
    uint cut_pixel = 0;
    uint cut_sample = 0;
    for (uint slot = first; slot < last; ++slot) {
        const uint fate = fates[slot];
        active += fate & FATE_ACTIVE;
        connections += (fate & FATE_CONNECTED) / FATE_CONNECTED;
        resumed += (fate & FATE_RESUMED) / FATE_RESUMED;
        if (fate & FATE_CUT) {
            const uint pixel = PLANE(ids, ID_PIXEL)[slot];
            const uint sample = reverse_bits_32(PLANE(ids, ID_INDEX)[slot]);
            const int first = cut == 0 || pixel < cut_pixel;
            cut_sample = first || (pixel == cut_pixel && sample < cut_sample) ? sample : cut_sample;
            cut_pixel = first ? pixel : cut_pixel;
            ++cut;
        }
        if (!(fate & FATE_ENDED)) continue;
        row[min(PLANE(ids, ID_SCATTERING)[slot], DEPTH_BINS - 1u)] += 1;
    }
    row[DEPTH_BINS] += connections;
    chunks[chunk].active = active;
    chunks[chunk].resumed = resumed;
    chunks[chunk].cut = cut;
    chunks[chunk].cut_pixel = cut_pixel;
    chunks[chunk].cut_sample = cut_sample;
}
