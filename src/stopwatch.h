// Wall time of the program's own steps.
#pragma once

#include <chrono>

namespace wavepath {

class Stopwatch {
  public:
    // Seconds since the last lap, or since the start.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace wavepath
