// The settings that a chart compares.
#pragma once

#include "commands/render_job.h"

#include <string>
#include <vector>

namespace wavepath {

struct Variant {
    std::string label;  // as it was asked for: "path --termination depth:4"
    std::string device;
    RenderSettings settings;  // with the camera and size of the job
};

// `list`: methods with options of their own behind them, separated by commas: "mis,path --sampler
// independent,direct". All else is as `options` say, and the view is that of `job`. Throws Error,
// with the variant's label, for what `render` would refuse, and for one that stands there twice.
std::vector<Variant> parse_variants(
    const std::string& list, const RenderOptions& options, const RenderJob& job);

}  // namespace wavepath
