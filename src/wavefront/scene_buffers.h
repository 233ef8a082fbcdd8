// The scene on the device.
#pragma once

#include "prepare/prepared_scene.h"
#include "shared/scene.h"
#include "wavefront/kernel_buffers.h"

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
    SceneBuffers(const Device& device, const Scene& scene, const PreparedScene& prepared);

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
