// Image files of a few bytes, and textures made in memory.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace wavepath {

// RGBA of 8 bits as a PNG or, without alpha and changed a little, as a JPEG.
std::string png_file(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba);
std::string jpeg_file(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba);

// 2 x 1 texels of 16 bits: (0, 32768, 65535, 12345) (1, 2, 3, 4).
std::string wide_png_file();
// 1 x 1 texel, grey 128, with a gAMA chunk.
std::string gamma_png_file();
// 2 x 2 texels, green, lossless.
std::string webp_file();

std::string base64_of(const std::string& bytes);

// Four 8-bit codes a texel.
TextureImage image_of(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgba);
// One texel, linear, of 16-bit codes.
TextureImage texel_image(double r, double g, double b, double a = 1);

// Makes material `material` of the scene use `image` for `use`, linear and unwrapped but for
// repeats; returns the texture.
Texture& add_texture(Scene& scene, Material& material, TextureUse use, TextureImage image);

}  // namespace wavepath
