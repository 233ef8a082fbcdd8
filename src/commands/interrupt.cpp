#include "commands/interrupt.h"

#include <csignal>

namespace wavepath {

namespace {

volatile std::sig_atomic_t interrupt_requested = 0;

void on_interrupt(int) {
    interrupt_requested = 1;
    std::signal(SIGINT, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupt_requested = 0;
    std::signal(SIGINT, on_interrupt);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
}

bool InterruptGuard::requested() const {
    return interrupt_requested != 0;
}

}  // namespace wavepath
