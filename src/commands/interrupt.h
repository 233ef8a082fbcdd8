// Signals as a request to stop after the current pass, so that none of them loses a picture.
#pragma once

namespace wavepath {

// Thrown when what there is has been written; main answers with exit status 128 + signal.
struct Interrupted {
    int signal;
};

// The signal that asked the last InterruptGuard to stop; 0: none did.
int interrupt_signal();

// To be called before drivers are loaded, which set handlers of their own. Writing to a pipe that
// nobody reads or beyond the limit on file sizes fails from then on, where SIGPIPE and SIGXFSZ
// ended the process.
void prepare_signals();

// While it lives SIGINT, SIGTERM, SIGHUP and SIGXCPU set a flag, and so do a SIGPIPE and a SIGXFSZ
// that come from elsewhere; a second Ctrl-C ends the process at once. SIGHUP stays ignored under
// nohup. After it these signals do nothing: what remains is to write the pictures, which takes a
// moment and must not be cut short.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool requested() const { return interrupt_signal() != 0; }
};

}  // namespace wavepath
