#include "device/scene_buffers.h"

#include "scene/device_material.h"

#include <algorithm>
#include <bit>

namespace wavepath {

namespace {

// What kernels/geometry/attributes.cl reads.
std::vector<cl_float> triangle_records(const NormalisedScene& geometry, const LightTables& lights) {
    struct Attribute {
        const std::vector<float>& values;
        std::size_t floats;
    };
    const std::array<Attribute, 6> attributes{
        {{geometry.normals, 9},
         {geometry.colors, 9},
         {geometry.uvs[0], 6},
         {geometry.uvs[1], 6},
         {geometry.tangents, 9},
         {geometry.alphas, 3}}};
    std::size_t floats = TRIANGLE_ATTRIBUTES;
    for (const auto& [values, width] : attributes) floats += values.empty() ? 0 : width;
    std::vector<cl_float> records(floats * geometry.triangle_count());
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t) {
        float* record = &records[floats * t];
        record[TRIANGLE_MATERIAL] = std::bit_cast<float>(geometry.materials[t]);
        record[TRIANGLE_LIGHT] = std::bit_cast<float>(lights.triangle_lights[t]);
        std::copy_n(&geometry.positions[9 * t], 9, record + TRIANGLE_CORNERS);
        if (!geometry.bitangents.empty()) record[TRIANGLE_BITANGENT] = geometry.bitangents[t];
        float* attribute = record + TRIANGLE_ATTRIBUTES;
        for (const auto& [values, width] : attributes)
            if (!values.empty()) attribute = std::copy_n(&values[width * t], width, attribute);
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

std::size_t DeviceTextures::bytes() const {
    std::size_t bytes = rows.bytes();
    for (const DeviceArray<cl_uint>& page : pages) bytes += page.bytes();
    return bytes;
}

SceneBuffers::SceneBuffers(
    const Device& device,
    const Scene& scene,
    const NormalisedScene& geometry,
    const Bvh& bvh,
    const LightTables& tables,
    const MediaTables& media_tables,
    const TextureTables& texture_tables)
    : nodes(device, bvh.nodes, "BVH nodes"),
      blocks(device, bvh.blocks, "BVH leaves"),
      triangles(device, triangle_records(geometry, tables), "triangles"),
      materials(device, device_materials(scene, media_tables), "materials"),
      lights(device, tables.lights, "lights"),
      media(device, media_tables.media, "media"),
      environment(device, tables.environment, "environment map"),
      textures{DeviceArray<DeviceTexture>(device, texture_tables.rows, "textures"), {}} {
    for (std::size_t page = 0; page < textures.pages.size(); ++page) {
        const uint64_t before = page * texture_tables.page_words;
        const uint64_t left = texture_tables.words - std::min(texture_tables.words, before);
        textures.pages[page] =
            DeviceArray<cl_uint>(device, std::min(left, texture_tables.page_words), "texels");
    }
    write_texels(device, texture_tables.page_words, 0, texture_tables.curves);
    for (std::size_t image = 0; image < texture_tables.first_words.size(); ++image)
        write_texels(
            device, texture_tables.page_words, texture_tables.first_words[image],
            scene.images[image].words);
}

void SceneBuffers::write_texels(
    const Device& device,
    uint64_t page_words,
    uint64_t first,
    const std::vector<cl_uint>& words) const {
    for (uint64_t done = 0; done < words.size();) {
        const uint64_t at = (first + done) % page_words;
        const uint64_t count = std::min(words.size() - done, page_words - at);
        device.queue.enqueueWriteBuffer(
            textures.pages[(first + done) / page_words].buffer(), CL_TRUE, at * sizeof(cl_uint),
            count * sizeof(cl_uint), &words[done]);
        done += count;
    }
}

std::size_t SceneBuffers::bytes() const {
    return nodes.bytes() + blocks.bytes() + triangles.bytes() + materials.bytes() + lights.bytes() +
           media.bytes() + environment.bytes() + textures.bytes();
}

}  // namespace wavepath
