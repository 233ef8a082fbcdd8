// The node tree, and what hangs on its nodes besides meshes.
#pragma once

#include "gltf/gltf_file.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace wavepath {

struct PlacedNode {
    const tinygltf::Node& node;
    int index;          // into the file's nodes
    std::string label;  // for messages
    Matrix4 to_world;   // finite, affine
    bool visible;       // with its meshes and lights [KHR_node_visibility]
};

// Nodes of one scene in depth-first order. `scene`: its name or index; empty: the scene that the
// file calls its default, else its first, else all nodes of a file without scenes. Throws Error
// where there is no such scene, or its nodes do not form a tree.
std::vector<PlacedNode> place_nodes(const GltfFile& file, const std::string& scene);

// Perspective or orthographic. The frame is orthonormal: a view ignores its node's scale [glTF 2.0,
// section 3.10.2].
std::optional<Camera> read_camera(const GltfFile& file, const PlacedNode& placed);

// KHR_lights_punctual: the node gives place and direction; its scale does not change the light.
std::optional<PunctualLight> read_light(const GltfFile& file, const PlacedNode& placed);

}  // namespace wavepath
