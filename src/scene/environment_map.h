#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace wavepath {

// Reads a latitude-longitude map, Radiance .hdr or OpenEXR .exr, as linear RGB radiance (scale 1).
// Throws Error for a file that is missing, unreadable, or holds a negative or non-finite texel.
Environment load_environment_map(const std::filesystem::path& path);

}  // namespace wavepath
