#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace wavepath {

inline constexpr uint64_t default_most_texels = uint64_t{1} << 28U;  // 1 GiB of 8-bit texels

// Reads a .gltf or .glb file: default scene (the first where the file names none, all nodes where
// it has no scene), node hierarchy in double, all vertex and index encodings of core glTF 2.0 and
// KHR_mesh_quantization, cameras, KHR_lights_punctual, the materials of scene.h and their images,
// of `most_texels` texels in all at the most. What the scene does not reach is neither read nor
// judged; what it asks for and gets not is in Scene::ignored. Throws Error, naming the file and the
// element, for a file that is missing, malformed, requires an extension we lack, or holds an index
// out of range or a non-finite number; for a scene without triangles.
Scene load_gltf(const std::filesystem::path& path, uint64_t most_texels = default_most_texels);

}  // namespace wavepath
