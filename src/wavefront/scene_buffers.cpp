#include "wavefront/scene_buffers.h"

#include "prepare/device_material.h"

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
    if (std::ranges::any_of(scene.materials, &Material::transmits_in_part))
        for (std::size_t m = 0; m < scene.materials.size(); ++m)
            materials.push_back(opaque_rest(materials[m]));
    return materials;
}

}  // namespace

std::size_t DeviceTextures::bytes() const {
    std::size_t bytes = rows.bytes();
    for (const DeviceArray<cl_uint>& page : pages) bytes += page.bytes();
    return bytes;
}

SceneBuffers::SceneBuffers(const Device& device, const Scene& scene, const PreparedScene& prepared)
    : nodes(device, prepared.placed.bvh.nodes, "BVH nodes"),
      blocks(device, prepared.placed.bvh.blocks, "BVH leaves"),
      mesh(
          device,
          prepared.mesh ? std::vector<SmallMesh>{*prepared.mesh} : std::vector<SmallMesh>{},
          "small mesh"),
      triangles(device, triangle_records(prepared.geometry(), prepared.lights), "triangles"),
      materials(device, device_materials(scene, prepared.media), "materials"),
      lights(device, prepared.lights.lights, "lights"),
      media(device, prepared.media.media, "media"),
      environment(device, prepared.lights.environment, "environment map"),
      textures{DeviceArray<DeviceTexture>(device, prepared.textures.rows, "textures"), {}} {
    const TextureTables& texture_tables = prepared.textures;
    // Pages are mapped whole: oclgrind takes what is written from an offset on for uninitialised.
    std::array<cl_uint*, TEXTURE_MOST_PAGES> mapped{};
    for (std::size_t page = 0; page < mapped.size(); ++page) {
        const uint64_t before = page * texture_tables.page_words;
        const uint64_t left = texture_tables.words - std::min(texture_tables.words, before);
        DeviceArray<cl_uint>& array = textures.pages[page];
        array = DeviceArray<cl_uint>(device, std::min(left, texture_tables.page_words), "texels");
        if (array.size() > 0)
            mapped[page] = static_cast<cl_uint*>(device.queue.enqueueMapBuffer(
                array.buffer(), CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, array.bytes()));
    }
    const auto copy = [&](uint64_t first, const std::vector<cl_uint>& words) {
        for (uint64_t done = 0; done < words.size();) {
            const uint64_t at = (first + done) % texture_tables.page_words;
            const uint64_t count = std::min(words.size() - done, texture_tables.page_words - at);
            std::copy_n(
                &words[done], count, mapped[(first + done) / texture_tables.page_words] + at);
            done += count;
        }
    };
    copy(0, texture_tables.curves);
    for (std::size_t image = 0; image < texture_tables.first_words.size(); ++image)
        copy(texture_tables.first_words[image], scene.images[image].words);
    for (std::size_t page = 0; page < mapped.size(); ++page)
        if (mapped[page] != nullptr)
            device.queue.enqueueUnmapMemObject(textures.pages[page].buffer(), mapped[page]);
}

std::size_t SceneBuffers::bytes() const {
    KernelBuffers buffers;
    name(buffers);
    return buffers.bytes();
}

void SceneBuffers::name(KernelBuffers& buffers) const {
    buffers.add("nodes", nodes, Access::read);
    buffers.add("blocks", blocks, Access::read);
    buffers.add("mesh", mesh, Access::read);
    buffers.add("triangles", triangles, Access::read);
    buffers.add("materials", materials, Access::read);
    buffers.add("lights", lights, Access::read);
    buffers.add("media", media, Access::read);
    buffers.add("environment", environment, Access::read);
    buffers.add("textures", textures.rows, Access::read);
    for (std::size_t page = 0; page < textures.pages.size(); ++page)
        buffers.add(fmt::format("texels_{}", page), textures.pages[page], Access::read);
}

}  // namespace wavepath
