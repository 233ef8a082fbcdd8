#include "device/scene_buffers.h"

#include "scene/device_material.h"

#include <bit>

namespace wavepath {

namespace {

std::vector<cl_float> triangle_records(const NormalisedScene& geometry, const LightTables& lights) {
    const std::size_t floats = TRIANGLE_ATTRIBUTES + (geometry.normals.empty() ? 0 : 9) +
                               (geometry.colors.empty() ? 0 : 9);
    std::vector<cl_float> records(floats * geometry.triangle_count());
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t) {
        float* record = &records[floats * t];
        record[TRIANGLE_MATERIAL] = std::bit_cast<float>(geometry.materials[t]);
        record[TRIANGLE_LIGHT] = std::bit_cast<float>(lights.triangle_lights[t]);
        std::copy_n(&geometry.positions[9 * t], 9, record + TRIANGLE_CORNERS);
        float* attribute = record + TRIANGLE_ATTRIBUTES;
        if (!geometry.normals.empty())
            attribute = std::copy_n(&geometry.normals[9 * t], 9, attribute);
        if (!geometry.colors.empty()) std::copy_n(&geometry.colors[9 * t], 9, attribute);
    }
    return records;
}

std::vector<DeviceMaterial> device_materials(const Scene& scene, const MediaTables& media) {
    std::vector<DeviceMaterial> materials;
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
        materials.push_back(device_material(scene.materials[m], media.rows[m]));
    return materials;
}

}  // namespace

SceneBuffers::SceneBuffers(
    const Device& device,
    const Scene& scene,
    const NormalisedScene& geometry,
    const Bvh& bvh,
    const LightTables& tables,
    const MediaTables& media_tables)
    : nodes(device, bvh.nodes, "BVH nodes"),
      blocks(device, bvh.blocks, "BVH leaves"),
      triangles(device, triangle_records(geometry, tables), "triangles"),
      materials(device, device_materials(scene, media_tables), "materials"),
      lights(device, tables.lights, "lights"),
      media(device, media_tables.media, "media"),
      environment(device, tables.environment, "environment map") {}

std::size_t SceneBuffers::bytes() const {
    return nodes.bytes() + blocks.bytes() + triangles.bytes() + materials.bytes() + lights.bytes() +
           media.bytes() + environment.bytes();
}

}  // namespace wavepath
