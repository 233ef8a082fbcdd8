// Textures as the device has them: kernels/shared/texture.h and materials/texture.cl are the other
// side.
#pragma once

#include "scene/scene.h"

namespace wavepath {

// Words are counted through all pages.
struct TextureTables {
    std::vector<DeviceTexture> rows;    // TEXTURE_USES a material; empty: no textures, no holes
    std::vector<uint32_t> curves;       // SRGB_8_TABLE and SRGB_16_TABLE, from word 0 on
    std::vector<uint32_t> first_words;  // of each of Scene::images
    uint64_t words = 0;                 // of curves and images
    uint64_t page_words = 0;            // of a full page

    uint32_t pages() const;
};

// `used`: whether some triangle wears a material. Pages have at most `page_bytes`. Throws Error
// where TEXTURE_MOST_PAGES of them do not hold all texels. `always`: rows also where nothing asks
// for them.
TextureTables build_texture_tables(
    const Scene& scene, const std::vector<bool>& used, uint64_t page_bytes, bool always = false);

// Luminance of a texture [1], to choose lights by.
class TextureLuminance {
  public:
    TextureLuminance(const Texture& texture, const TextureImage& image);

    double whole() const { return whole_; }  // mean of the image

    // Mean over a triangle with these 6 texture coordinates: of the texels at points of it, and a
    // little of the whole image's, so that it is positive wherever the filter may show some.
    double over(const float* uvs) const;

  private:
    Texture texture_;
    uint32_t width_, height_;
    std::vector<float> texels_;
    double whole_ = 0;
};

}  // namespace wavepath
