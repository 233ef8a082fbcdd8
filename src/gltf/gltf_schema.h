// The JSON types of the members that this program reads: tinygltf drops members of other types
// without a word.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace wavepath {

// Writes integers that stand as 1.0 in `root`, which JSON Schema allows [JSON Schema 2020-12,
// section 6.1.1], as 1. Returns where and how the first member that is read has the wrong type, or
// what is missing, as in `material 3 "red": doubleSided is 1, not true or false`; "" if all is
// well. Members that nothing reads, and extensions that are not supported, are not judged.
std::string put_types_right(nlohmann::json& root);

}  // namespace wavepath
