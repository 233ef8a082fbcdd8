// Renders for a person who watches: what is ignored and what went wrong is said, signals are
// heeded.
#pragma once

#include "commands/render_options.h"

namespace wavepath {

// Throws Interrupted if a signal to stop comes before every pixel has a sample; later it sets the
// result's `interrupted`.
RenderResult run_job(const Device& device, const RenderJob& job, bool quiet);

}  // namespace wavepath
