// Where tinygltf is stricter than glTF, it is handed what it can read.
#pragma once

#include <tiny_gltf.h>
#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace wavepath {

// Changes `root`, whose types are right: animations, which this program does not read, become
// empty, as tinygltf wants each to move a node; skins without inverse bind matrices, which they may
// lack [glTF 2.0, section 5.28], get the index -1; and `indices` are taken out of the primitives,
// as tinygltf wants their accessors to have a buffer view. Returns the indices.
std::vector<int> put_placeholders(nlohmann::json& root);

// Gives primitives the indices that put_placeholders took from them.
void put_indices_back(const std::vector<int>& indices, tinygltf::Model& model);

}  // namespace wavepath
