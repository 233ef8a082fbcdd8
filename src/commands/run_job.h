// Renders for a person who watches: what is ignored and what went wrong is said, signals are
// heeded.
#pragma once

#include "commands/outputs.h"

#include <functional>
#include <nlohmann/json.hpp>

namespace wavepath {

// Looks at a finished render: may add keys to its report, and prints to standard output.
using Inspect = std::function<void(
    const Device&, const RenderJob&, const RenderResult&, nlohmann::ordered_json& report)>;

// From options to files; `inspect`, if any, comes between render and files. Throws Error, and what
// write_outputs throws; Interrupted also where a signal to stop comes before every pixel has a
// sample, and nothing is written.
void run_job(const RenderOptions& options, Outputs outputs, const Inspect& inspect = nullptr);

}  // namespace wavepath
