#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace wavepath {

// Sets (or, given nothing, unsets) an environment variable until the end of the scope.
class EnvironmentVariable {
  public:
    explicit EnvironmentVariable(
        const std::string& name, const std::optional<std::string>& value = {})
        : name_(name) {
        if (const char* before = std::getenv(name.c_str())) before_ = before;
        set(value);
    }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;
    ~EnvironmentVariable() { set(before_); }

  private:
    void set(const std::optional<std::string>& value) {
        if (value)
            setenv(name_.c_str(), value->c_str(), 1);
        else
            unsetenv(name_.c_str());
    }

    std::string name_;
    std::optional<std::string> before_;
};

}  // namespace wavepath
