// EXT_mesh_gpu_instancing: many copies of a node's mesh.
#pragma once

#include "gltf/gltf_nodes.h"

#include <vector>

namespace wavepath {

// Transforms from the mesh to the world, one an instance; the node's own where it has no instances.
std::vector<Matrix4> place_instances(const GltfFile& file, const PlacedNode& placed);

}  // namespace wavepath
