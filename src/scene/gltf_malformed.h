#pragma once

#include <string>
#include <string_view>

namespace wavepath {

// The first member of a material in the JSON that tinygltf drops without a word, and what it is: a
// null or an extension that is no object, outside of extras and extensions of others; "" if there
// is none.
std::string malformed_material(std::string_view json);

}  // namespace wavepath
