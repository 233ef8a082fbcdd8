// The scene on the device.
#pragma once

#include "device/device_array.h"
#include "scene/bvh_builder.h"
#include "scene/light_tables.h"
#include "scene/media_tables.h"
#include "scene/normalise.h"
#include "shared/scene.h"

namespace wavepath {

struct SceneBuffers {
    SceneBuffers(
        const Device& device,
        const Scene& scene,
        const NormalisedScene& geometry,
        const Bvh& bvh,
        const LightTables& tables,
        const MediaTables& media_tables);

    DeviceArray<BvhNode> nodes;
    DeviceArray<TriangleBlock> blocks;
    DeviceArray<cl_float> triangles;  // layout in kernels/shared/scene.h
    DeviceArray<DeviceMaterial> materials;
    DeviceArray<DeviceLight> lights;
    DeviceArray<DeviceMedium> media;
    DeviceArray<EnvironmentEntry> environment;

    std::size_t bytes() const;
};

}  // namespace wavepath
