// The path slots and what manages them: everything that is sized by --pool.
#pragma once

#include "shared/queues.h"
#include "wavefront/features.h"
#include "wavefront/kernel_buffers.h"

namespace wavepath {

struct PathPool {
    PathPool() = default;  // holds nothing
    PathPool(const Device& device, uint32_t slots, const Features& features);

    uint32_t slots = 0;
    uint32_t stride = 0;  // of the planes: the slots, padded so that planes do not fall on the same
                          // cache sets
    DeviceArray<cl_float> rays, hits, surfaces, throughputs, radiances;
    DeviceArray<cl_float> shadows;   // only where lights are sampled
    DeviceArray<cl_float> media;     // only in scenes with media
    DeviceArray<cl_float> branches;  // only with --splits
    DeviceArray<cl_uint> ids;

    DeviceArray<cl_uchar> fates;
    DeviceArray<ChunkState> chunk_states;
    DeviceArray<cl_uint> holes, movers;
    DeviceArray<cl_uint> statistics;  // STATISTICS a chunk

    uint32_t chunks() const { return (slots + QUEUE_CHUNK - 1) / QUEUE_CHUNK; }
    std::size_t bytes() const;
    // Under the names that kernels use.
    void name(KernelBuffers& buffers) const;
};

}  // namespace wavepath
