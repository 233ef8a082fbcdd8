// Skins: meshes bent by the nodes they hang on [glTF 2.0, section 3.7.3].
#pragma once

#include "gltf/gltf_nodes.h"

#include <span>
#include <vector>

namespace wavepath {

// Which joints move a vertex: `width` (joint, weight) pairs each.
struct JointWeights {
    std::size_t width = 0;
    std::vector<std::uint32_t> joints;  // into the skin's, width a vertex
    std::vector<float> weights;         // >= 0, their sum 1 a vertex
};

// From the mesh to the world, one a joint of skin `index`: the joint's transform times its inverse
// bind matrix. `node_to_world`: of every node by its index, null where the scene does not reach it.
std::vector<Matrix4> joint_matrices(
    const GltfFile& file,
    int index,
    std::span<const Matrix4* const> node_to_world,
    std::string_view where);

// All JOINTS_n and WEIGHTS_n of `source`. Weights are divided by their sum, however far it is from
// 1; a vertex without weight follows its first joint.
JointWeights read_joint_weights(
    const GltfFile& file,
    const tinygltf::Primitive& source,
    std::size_t vertex_count,
    std::size_t joint_count,
    std::string_view where);

// Moves positions and normals. Throws Error where a position leaves single precision.
void apply_skin(
    const GltfFile& file,
    Primitive& primitive,
    const JointWeights& influences,
    const std::vector<Matrix4>& joints,
    std::string_view where);

}  // namespace wavepath
