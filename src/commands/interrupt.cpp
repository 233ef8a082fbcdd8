#include "commands/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <string_view>

namespace wavepath {

namespace {

volatile sig_atomic_t first_signal = 0;
bool under_nohup = false;

constexpr int stopping_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE, SIGXFSZ};

double seconds_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);  // may be called by a signal handler
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// timeout(1) signals the process and then its group: what comes at once is the same Ctrl-C.
constexpr double same_interrupt_s = 0.3;
double first_interrupt_s = 0;

// What this process' own write(2) raises: a reader is gone or a file is too large, which its
// caller is told as well.
bool is_of_own_write(int signal, const siginfo_t& info) {
    return (signal == SIGPIPE || signal == SIGXFSZ) && info.si_pid == getpid();
}

void on_signal(int signal, siginfo_t* info, void*) {
    if (is_of_own_write(signal, *info)) return;
    if (first_signal != 0) {
        // A hangup comes from the terminal and from its shell, SIGXCPU every second.
        if (signal != SIGINT || seconds_now() - first_interrupt_s < same_interrupt_s) return;
        ::signal(SIGINT, SIG_DFL);
        raise(SIGINT);
        return;
    }
    first_signal = signal;
    first_interrupt_s = seconds_now();
    constexpr std::string_view words =
        "\nstopping after this pass; Ctrl-C again ends at once, without a picture\n";
    const int error = errno;  // of whatever was interrupted
    [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
    errno = error;
}

}  // namespace

int interrupt_signal() {
    return first_signal;
}

void prepare_signals() {
    struct sigaction before {};
    sigaction(SIGHUP, nullptr, &before);
    under_nohup = before.sa_handler == SIG_IGN;
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

InterruptGuard::InterruptGuard() {
    first_signal = 0;
    struct sigaction action {};
    action.sa_sigaction = on_signal;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    for (const int signal : stopping_signals) sigaction(signal, &action, nullptr);
    if (under_nohup) signal(SIGHUP, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
    for (const int signal : stopping_signals) ::signal(signal, SIG_IGN);
}

}  // namespace wavepath
