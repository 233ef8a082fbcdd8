#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace wavepath {

inline constexpr uint64_t default_most_texels = uint64_t{1} << 28U;  // 1 GiB of 8-bit texels

// Reads a scene of a .gltf or .glb file, docs/gltf.md says what of it. `scene`: name or index;
// empty: the file's default scene, else its first, else all nodes of a file without scenes; with
// its images, of `most_texels` texels in all at the most. Punctual lights are divided by
// `lumens_per_watt`. What the scene does not reach is neither
// read nor judged; what it asks for and gets not is in Scene::ignored. Throws Error, naming the
// file and the element, for a file that is missing, malformed, requires an extension we lack, or
// holds an index out of range or a non-finite number; for a scene without triangles, or with more
// than memory holds.
Scene load_gltf(
    const std::filesystem::path& path,
    const std::string& scene = "",
    uint64_t most_texels = default_most_texels,
    double lumens_per_watt = 1);

}  // namespace wavepath
