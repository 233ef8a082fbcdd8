// Renders for a person who watches: what is ignored and what went wrong is said, signals are
// heeded.
#pragma once

#include "commands/outputs.h"

#include <functional>

namespace wavepath {

// Prints what a render took to standard output.
using PrintResult = std::function<void(const Device&, const RenderJob&, const RenderResult&)>;

// From options to files; `print`, if any, comes between render and files. Throws Error, and what
// write_outputs throws; Interrupted also where a signal to stop comes before every pixel has a
// sample, and nothing is written.
void run_job(const RenderOptions& options, Outputs outputs, const PrintResult& print = nullptr);

}  // namespace wavepath
