#include "wavefront/path_pool.h"

#include "shared/path.h"

namespace wavepath {

namespace {

// Planes a power of two apart share cache sets: 5x slower on PoCL at 2^20 slots.
uint32_t padded(uint32_t slots) {
    return (slots + 15) / 16 * 16 + 80;
}

uint32_t surface_planes(const Features& features) {
    if (features.lobe_textures) return SURFACE_PLANES;
    return features.shading_normals() ? SURFACE_PLANES_SHADED : SURFACE_PLANES_FLAT;
}

uint32_t medium_planes(const Features& features) {
    if (!features.passages()) return 0;
    return features.contacts ? MEDIUM_PLANES : MEDIUM_PLANES_APART;
}

uint32_t shadow_planes(const Features& features) {
    if (!features.sample_lights) return 0;
    if (features.lamps_on_lamps) return SHADOW_PLANES;
    return features.media ? SHADOW_PLANES_ALONE : SHADOW_PLANES_CLEAR;
}

}  // namespace

PathPool::PathPool(const Device& device, uint32_t slot_count, const Features& features)
    : slots(slot_count),
      stride(padded(slot_count)),
      rays(device, std::size_t{RAY_PLANES} * stride, "path pool"),
      hits(device, std::size_t{HIT_PLANES} * stride, "path pool"),
      surfaces(device, std::size_t{surface_planes(features)} * stride, "path pool"),
      throughputs(device, std::size_t{THROUGHPUT_PLANES} * stride, "path pool"),
      radiances(device, std::size_t{RADIANCE_PLANES} * stride, "path pool"),
      shadows(device, std::size_t{shadow_planes(features)} * stride, "path pool"),
      media(device, std::size_t{medium_planes(features)} * stride, "path pool"),
      branches(
          device,
          static_cast<std::size_t>(features.media ? 2 * BRANCH_PLANES : BRANCH_PLANES_SURFACE) *
              features.split_levels * stride,
          "path pool"),
      ids(device,
          std::size_t{features.split_levels > 0 ? ID_PLANES : ID_PLANES_UNSPLIT} * stride,
          "path pool"),
      fates(device, slots, "path pool"),
      chunk_states(device, chunks(), "path pool"),
      holes(device, slots, "path pool"),
      movers(device, std::size_t{slots} + 1, "path pool"),
      statistics(
          device, std::vector<cl_uint>(std::size_t{STATISTICS} * chunks(), 0), "statistics") {}

std::size_t PathPool::bytes() const {
    KernelBuffers buffers;
    name(buffers);
    return buffers.bytes();
}

void PathPool::name(KernelBuffers& buffers) const {
    buffers.add("rays", rays, Access::write);
    buffers.add("hits", hits, Access::write);
    buffers.add("surfaces", surfaces, Access::write);
    buffers.add("throughputs", throughputs, Access::write);
    buffers.add("radiances", radiances, Access::write);
    buffers.add("shadows", shadows, Access::write);
    buffers.add("path_media", media, Access::write);
    buffers.add("branches", branches, Access::write);
    buffers.add("ids", ids, Access::write);
    buffers.add("fates", fates, Access::write);
    buffers.add("chunks", chunk_states, Access::write);
    buffers.add("holes", holes, Access::write);
    buffers.add("movers", movers, Access::write);
    buffers.add("statistics", statistics, Access::write);
}

}  // namespace wavepath
