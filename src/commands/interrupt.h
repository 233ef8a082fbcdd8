// Ctrl-C as a request to stop after the current pass.
#pragma once

namespace wavepath {

// Thrown when what there is has been written; main answers with exit status 130.
struct Interrupted {};

// While it lives, SIGINT sets a flag; a second SIGINT ends the process at once. After it, SIGINT
// does nothing: what remains is to write the pictures, which takes a moment and must not be cut
// short.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool requested() const;
};

}  // namespace wavepath
