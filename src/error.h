// The one exception of the program: says what is wrong, where, and what to do. Caught once, in
// main.
#pragma once

#include <fmt/format.h>

#include <stdexcept>

namespace wavepath {

class Error : public std::runtime_error {
  public:
    template <typename... Args>
    explicit Error(fmt::format_string<Args...> format, Args&&... args)
        : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

}  // namespace wavepath
