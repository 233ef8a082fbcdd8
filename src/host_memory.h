#pragma once

#include <cstddef>

namespace wavepath {

// Memory that the system can still give to this process [byte]; the largest number where it does
// not say.
std::size_t available_memory();

}  // namespace wavepath
