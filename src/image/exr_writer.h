#pragma once

#include "image/image.h"

#include <filesystem>

namespace wavepath {

// Throws Error unless a file of this name can be written: called before rendering starts.
void check_writable(const std::filesystem::path& path);

// One part, 32-bit float, every channel and attribute of the image. Written to a temporary name in
// the same folder and renamed, so that the path holds a whole file or what was there before. Throws
// Error where that fails.
void write_exr(const Image& image, const std::filesystem::path& path);

// The channels and string attributes of an EXR file. Throws Error where it cannot be read.
Image read_exr(const std::filesystem::path& path);

}  // namespace wavepath
