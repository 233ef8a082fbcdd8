#include "wavefront/path_pool.h"

#include "shared/path.h"

namespace wavepath {

namespace {

// Planes a power of two apart share cache sets: 5x slower on PoCL at 2^20 slots.
uint32_t padded(uint32_t slots) {
    return (slots + 15) / 16 * 16 + 80;
}

DeviceArray<QueueSizes> no_paths(const Device& device) {
    return {device, std::vector<QueueSizes>(1), "queue sizes"};
}

}  // namespace

PathPool::PathPool(const Device& device, uint32_t slot_count, const Features& features)
    : slots(slot_count),
      stride(padded(slot_count)),
      rays(device, std::size_t{RAY_PLANES} * stride, "path pool"),
      hits(device, std::size_t{HIT_PLANES} * stride, "path pool"),
      throughputs(device, std::size_t{THROUGHPUT_PLANES} * stride, "path pool"),
      radiances(device, std::size_t{RADIANCE_PLANES} * stride, "path pool"),
      shadows(device, features.sample_lights ? std::size_t{SHADOW_PLANES} * stride : 0, "path pool"),
      branches(device, 0, "path pool"),
      ids(device, std::size_t{ID_PLANES} * stride, "path pool"),
      active{DeviceArray<cl_uint>(device, slots, "path queue"), DeviceArray<cl_uint>(device, slots, "path queue")},
      sizes{no_paths(device), no_paths(device)},
      ended(device, slots, "path queue"),
      fates(device, slots, "path queue"),
      chunk_counts(device, chunks(), "path queue"),
      statistics(device, std::vector<cl_uint>(std::size_t{STATISTICS} * chunks(), 0), "statistics") {}

std::size_t PathPool::bytes() const {
    return rays.bytes() + hits.bytes() + throughputs.bytes() + radiances.bytes() + shadows.bytes() + branches.bytes() +
           ids.bytes() + active[0].bytes() + active[1].bytes() + sizes[0].bytes() + sizes[1].bytes() + ended.bytes() +
           fates.bytes() + chunk_counts.bytes() + statistics.bytes();
}

}  // namespace wavepath
