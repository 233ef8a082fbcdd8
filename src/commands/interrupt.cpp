#include "commands/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace wavepath {

namespace {

volatile std::sig_atomic_t interrupt_requested = 0;

void on_interrupt(int) {
    interrupt_requested = 1;
    std::signal(SIGINT, SIG_DFL);
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
