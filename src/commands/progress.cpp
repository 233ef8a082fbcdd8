#include "commands/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace wavepath {

Progress::Progress(const RenderSettings& settings, bool quiet)
    : settings_(settings),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      next_(terminal_ ? 0 : 10) {}

void Progress::show(const RenderProgress& state) {
    if (quiet_ || state.seconds < next_) return;
    next_ = state.seconds + (terminal_ ? 0.5 : 10);
    // not fmt::print, which throws where nobody listens
    std::fputs(
        ((terminal_ ? "\r\033[K" : "") + line(state) + (terminal_ ? "" : "\n")).c_str(), stderr);
    std::fflush(stderr);
    shown_ = true;
}

std::string relative_error_text(double relative_error) {
    return std::isfinite(relative_error) ? fmt::format("{:.2g}", relative_error) : "unknown";
}

void Progress::finish() {
    if (shown_ && terminal_) std::fputs("\n", stderr);
}

std::string Progress::line(const RenderProgress& state) const {
    const double samples = static_cast<double>(state.samples) * settings_.width * settings_.height;
    const double error = state.relative_error();
    double left = 0;  // [s]
    if (state.samples_wanted > 0)
        left = state.seconds *
               (static_cast<double>(state.samples_wanted) / static_cast<double>(state.samples) - 1);
    else if (settings_.seconds > 0)
        left = std::max(0.0, settings_.seconds - state.seconds);
    else if (std::isfinite(error))  // error falls with the root of the samples
        left = state.seconds * std::max(0.0, std::pow(error / settings_.target_error, 2) - 1);
    return fmt::format(
        "{}{} samples a pixel, {:.2f} Msamples/s, {:.2f} Mrays/s, relative error {}, {:.0f} s "
        "left",
        state.samples, state.samples_wanted > 0 ? fmt::format(" of {}", state.samples_wanted) : "",
        1e-6 * samples / state.seconds, 1e-6 * static_cast<double>(state.rays) / state.seconds,
        relative_error_text(error), left);
}

}  // namespace wavepath
