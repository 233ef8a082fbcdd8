// The queue of every stage is the range of slots in use. Slots refill as their paths end; once half
// of them have no work left, the live ones are moved together (scatter_queue, move_paths).
#ifndef WAVEPATH_QUEUES_H
#define WAVEPATH_QUEUES_H

#include "shared/cl_types.h"

#define QUEUE_CHUNK 256  // slots that one work-item of scan_queue and scatter_queue owns

// Bits of a slot's fate in this iteration.
#define FATE_ACTIVE 1u     // it has work in the next iteration too: this path, or another sample
#define FATE_ENDED 2u      // its path is over
#define FATE_CONNECTED 4u  // it traced a connection to a light

#define FATE_RESUMED \
    8u  // it goes on at a branch vertex: no ray to trace (written by resume_branch)

#define FATE_CUT 16u  // it was ended for its length, MAX_SCATTERINGS

#define DEPTH_BINS 16                // path lengths counted apart: 0 .. 14 scatterings, and longer
#define STATISTICS (DEPTH_BINS + 1)  // and connections traced

// What the host reads after every iteration, one a chunk.
typedef struct {
    shared_uint active;      // slots with work,
    shared_uint resumed;     // of which these need no ray
    shared_uint cut;         // paths ended for their length, MAX_SCATTERINGS
    shared_uint cut_pixel;   // of the first of them, in order of pixels and samples
    shared_uint cut_sample;  // and its sample
} ChunkState;
SHARED_SIZE(ChunkState, 20);

// A path this long is ended, counted and located: what it would still have brought is missing.
#define MAX_SCATTERINGS 1000000u

#endif
