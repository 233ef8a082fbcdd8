#pragma once

#include <string>
#include <string_view>

namespace wavepath {

// The first primitive of the JSON that names an accessor which is not there, in words; "" if none
// does. For tinygltf refuses such files without saying where.
std::string unresolved_accessor(std::string_view json);

}  // namespace wavepath
