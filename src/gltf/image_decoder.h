// PNG, JPEG and WebP files in memory.
#pragma once

#include "scene/scene.h"

#include <span>

namespace wavepath {

struct ImageSize {
    uint32_t width = 0, height = 0;
};

// Of what the header says. Throws Error where it is none of the three.
ImageSize read_image_size(std::span<const unsigned char> bytes);

// RGBA: alpha is 1 where the file has none, grey is repeated; PNGs of 16 bits keep them. Profiles
// and gamma values in the file are not heeded, as glTF asks for [glTF 2.0, section 3.8.3]. Throws
// Error for what is damaged or cut off.
TextureImage decode_image(std::span<const unsigned char> bytes);

}  // namespace wavepath
