// What a driver that ends the process says for itself, and what a user can do about it.
#pragma once

#include <signal.h>

#include <string>

namespace wavepath {

// "its kernel cache FOLDER may be damaged or not writable ...": why PoCL fails without a compiler's
// message, and what to do.
std::string pocl_cache_advice();

// While it lives, a driver that crashes, aborts or exits ends the process with status 1 and one
// line. PoCL does so where files of its kernel cache are damaged or cannot be written, or where
// memory or threads run out. LLVM sets handlers of its own as PoCL is loaded: to be made after
// that. One at a time.
class DriverFailureGuard {
  public:
    DriverFailureGuard();
    ~DriverFailureGuard();
    DriverFailureGuard(const DriverFailureGuard&) = delete;
    DriverFailureGuard& operator=(const DriverFailureGuard&) = delete;

  private:
    struct sigaction before_[5];  // what crashes did
};

}  // namespace wavepath
