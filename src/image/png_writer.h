#pragma once

#include "image/image.h"

#include <filesystem>

namespace wavepath {

// 8-bit sRGB of channels R, G, B scaled by 2^exposure and clipped to [0, 1]; non-finite pixels are
// magenta. Written to a temporary name and renamed. Throws Error where that fails.
void write_png(const Image& image, const std::filesystem::path& path, double exposure);

}  // namespace wavepath
