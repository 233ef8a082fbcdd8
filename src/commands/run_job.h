// Renders for a person who watches: what is ignored and what went wrong is said, Ctrl-C is heeded.
#pragma once

#include "commands/render_options.h"

namespace wavepath {

// Throws Interrupted if Ctrl-C comes before every pixel has a sample; later it sets the result's
// `interrupted`.
RenderResult run_job(const Device& device, const RenderJob& job, bool quiet);

}  // namespace wavepath
