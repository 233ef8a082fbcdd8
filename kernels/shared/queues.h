// Queues of path slots. A queue keeps the order of its slots, so that neighbours stay neighbours and the order of nothing
// depends on chance; its length lives on the device, and kernels guard against it.
#ifndef WAVEPATH_QUEUES_H
#define WAVEPATH_QUEUES_H

#include "shared/cl_types.h"

#define QUEUE_CHUNK 256  // entries that one work-item of scan_queue and scatter_queue owns

// Bits of a queue entry's fate, settled by roulette_compact.
#define FATE_ACTIVE 1u  // the slot holds a path in the next iteration too: this one, or its next sample's
#define FATE_ENDED 2u   // this path is over

#define FATE_CONNECTED 4u  // it traced a connection to a light in this iteration (written by occlusion)

#define DEPTH_BINS 16  // path lengths counted apart: 0 .. 14 scatterings, and longer
#define STATISTICS (DEPTH_BINS + 1)  // and connections traced

typedef struct {
    shared_uint active;
    shared_uint ended;
    shared_uint runaway_lock;    // 1: a path passed MAX_SCATTERINGS, namely
    shared_uint runaway_pixel;   // of this pixel,
    shared_uint runaway_pass;    // this row of the plan,
    shared_uint runaway_sample;  // and this sample of its unit
    shared_uint padding[2];
} QueueSizes;
SHARED_SIZE(QueueSizes, 32);

// A path this long stops the run with an error: cutting it silently would be bias.
#define MAX_SCATTERINGS 1000000u

#endif
