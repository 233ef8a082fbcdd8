// The scene on the device.
#pragma once

#include "device/kernel_buffers.h"
#include "prepare/bvh_builder.h"
#include "prepare/light_tables.h"
#include "prepare/media_tables.h"
#include "prepare/normalise.h"
#include "prepare/small_mesh.h"
#include "prepare/texture_tables.h"
#include "shared/scene.h"

#include <optional>

namespace wavepath {

// TEXTURE_PARAMETERS of materials/texture.cl
struct DeviceTextures {
    DeviceArray<DeviceTexture> rows;  // TEXTURE_USES a material
    std::array<DeviceArray<cl_uint>, TEXTURE_MOST_PAGES> pages;

    std::size_t bytes() const;
};

struct SceneBuffers {
    SceneBuffers() = default;  // holds nothing
    SceneBuffers(
        const Device& device,
        const Scene& scene,
        const NormalisedScene& geometry,
        const Bvh& bvh,
        const std::optional<SmallMesh>& small_mesh,
        const LightTables& tables,
        const MediaTables& media_tables,
        const TextureTables& texture_tables);

    DeviceArray<BvhNode> nodes;
    DeviceArray<TriangleBlock> blocks;
    DeviceArray<SmallMesh> mesh;      // none, or one for packets
    DeviceArray<cl_float> triangles;  // layout in kernels/shared/scene.h
    DeviceArray<DeviceMaterial> materials;
    DeviceArray<DeviceLight> lights;
    DeviceArray<DeviceMedium> media;
    DeviceArray<EnvironmentEntry> environment;

    DeviceTextures textures;

    std::size_t bytes() const;
    // Under the names that kernels use.
    void name(KernelBuffers& buffers) const;
};

}  // namespace wavepath
