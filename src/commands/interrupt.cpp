#include "commands/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <ctime>
#include <string_view>

namespace wavepath {

namespace {

volatile std::sig_atomic_t interrupt_requested = 0;

double seconds_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);  // may be called by a signal handler
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// timeout(1) signals the process and then its group: what comes at once is the same Ctrl-C.
constexpr double same_interrupt_s = 0.3;
double first_interrupt_s = 0;

void on_interrupt(int) {
    if (interrupt_requested != 0) {
        if (seconds_now() - first_interrupt_s < same_interrupt_s) return;
        std::signal(SIGINT, SIG_DFL);
        std::raise(SIGINT);
        return;
    }
    interrupt_requested = 1;
    first_interrupt_s = seconds_now();
    constexpr std::string_view words =
        "\nstopping after this pass; Ctrl-C again ends at once, without a picture\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
}

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupt_requested = 0;
    std::signal(SIGINT, on_interrupt);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_IGN);
}

bool InterruptGuard::requested() const {
    return interrupt_requested != 0;
}

}  // namespace wavepath
