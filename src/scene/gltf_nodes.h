// The node tree, and what hangs on its nodes besides meshes.
#pragma once

#include "scene/gltf_file.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace wavepath {

struct PlacedNode {
    const tinygltf::Node& node;
    std::string label;  // for messages
    Matrix4 to_world;   // finite, affine
};

// Nodes of the default scene in depth-first order: of the scene the file names, else of its first;
// of all nodes where it has no scene. Throws Error where they do not form a tree.
std::vector<PlacedNode> place_nodes(const GltfFile& file);

// Perspective or orthographic. The frame is orthonormal: a view ignores its node's scale [glTF 2.0,
// section 3.10.2].
std::optional<Camera> read_camera(const GltfFile& file, const PlacedNode& placed);

// KHR_lights_punctual: the node gives place and direction; its scale does not change the light.
std::optional<PunctualLight> read_light(const GltfFile& file, const PlacedNode& placed);

}  // namespace wavepath
