// The path slots and their queues: everything that is sized by --pool.
#pragma once

#include "device/device_array.h"
#include "shared/queues.h"
#include "wavefront/features.h"

#include <array>

namespace wavepath {

struct PathPool {
    PathPool(const Device& device, uint32_t slots, const Features& features);

    uint32_t slots;
    uint32_t stride;  // of the planes: the slots, padded so that planes do not fall on the same cache sets
    DeviceArray<cl_float> rays, hits, throughputs, radiances;
    DeviceArray<cl_float> shadows;  // only where lights are sampled
    DeviceArray<cl_float> branches; // only with --splits
    DeviceArray<cl_uint> ids;

    std::array<DeviceArray<cl_uint>, 2> active;        // this iteration's queue and the next one's
    std::array<DeviceArray<QueueSizes>, 2> sizes;
    DeviceArray<cl_uint> ended;
    DeviceArray<cl_uchar> fates;
    DeviceArray<cl_uint2> chunk_counts;
    DeviceArray<cl_uint> statistics;  // STATISTICS a chunk

    uint32_t chunks() const { return (slots + QUEUE_CHUNK - 1) / QUEUE_CHUNK; }
    std::size_t bytes() const;
};

}  // namespace wavepath
