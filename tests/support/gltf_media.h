// glTF materials that enclose media.
#pragma once

#include "support/gltf_builder.h"
#include "support/images.h"

namespace wavepath {

// An index-matched boundary, to be changed at will.
inline GltfBuilder::Json boundary() {
    return {
        {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
        {"extensions",
         {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
          {"KHR_materials_ior", {{"ior", 1}}},
          {"KHR_materials_volume", {{"thicknessFactor", 0.1}}}}}};
}

inline GltfBuilder file_with(const GltfBuilder::Json& material) {
    GltfBuilder gltf;
    gltf.root["extensionsUsed"] = {
        "KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume"};
    gltf.root["extensionsRequired"] = gltf.root["extensionsUsed"];
    gltf.add("materials", material);
    gltf.object({{"attributes", {{"POSITION", gltf.triangle_positions()}}}, {"material", 0}});
    return gltf;
}

inline GltfBuilder::Json with_extras(const GltfBuilder::Json& medium) {
    GltfBuilder::Json material = boundary();
    material["extras"] = {{"wavepath_medium", medium}};
    return material;
}

inline void attenuate(GltfBuilder::Json& material) {
    GltfBuilder::Json& volume = material["extensions"]["KHR_materials_volume"];
    volume["attenuationColor"] = {0.5, 0.5, 0.5};
    volume["attenuationDistance"] = 2;
}

inline GltfBuilder with_image(const GltfBuilder::Json& material) {
    GltfBuilder gltf = file_with(material);
    gltf.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        gltf.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
    gltf.add("textures", {{"source", 0}});
    gltf.add(
        "images", {{"uri", "data:image/png;base64," + base64_of(png_file(1, 1, {9, 9, 9, 255}))}});
    return gltf;
}

}  // namespace wavepath
