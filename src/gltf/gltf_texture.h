// Textures of a glTF file: how materials refer to images, and the images.
#pragma once

#include "gltf/gltf_file.h"
#include "scene/scene.h"

namespace wavepath {

// Reads the textures of one material, `where` in messages.
class TextureReader {
  public:
    TextureReader(const GltfFile& file, std::string where, Material& material)
        : file_(file), where_(std::move(where)), material_(material) {}

    // Member `key` of the material: a textureInfo of tinygltf; of index -1: none.
    template <typename Info>
    void read(TextureUse use, const Info& info, const char* key) {
        if (info.index != -1) add(use, key, info.index, info.texCoord, info.extensions);
    }

    // Member `key` of an extension's object, where it has one.
    void read(TextureUse use, const tinygltf::Value& extension, const char* key);

  private:
    // Fails for what has no image, and for a third set of texture coordinates.
    void add(
        TextureUse use,
        const char* key,
        int index,
        int uv_set,
        const tinygltf::ExtensionMap& extensions);
    // `where`: the material and the member that refers to the texture.
    int read_transform(
        const tinygltf::Value& transform,
        int uv_set,
        std::string_view where,
        Texture& texture) const;
    void read_sampler(int index, std::string_view where, Texture& texture) const;
    uint32_t place_of_uv_set(int set);

    const GltfFile& file_;
    std::string where_;
    Material& material_;
};

// Decodes the images that the materials of the scene's primitives use, each once, into
// Scene::images, and makes the textures name them there; other materials lose their textures.
// Throws Error for an image that is missing, damaged or of a kind that is not supported, and for
// more than `most_texels` of them.
void load_images(const GltfFile& file, Scene& scene, uint64_t most_texels);

}  // namespace wavepath
