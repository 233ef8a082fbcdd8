// The renders of a chart, in order, and what is measured of them.
#pragma once

#include "commands/chart/chart_page.h"
#include "commands/chart/kept_renders.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

struct ChartOptions {
    RenderOptions render;
    std::string methods = "mis,direct-bsdf,direct,bsdf,path";
    std::filesystem::path reference;        // empty: rendered
    std::optional<uint64_t> reference_spp;  // of each half
    std::optional<double> budget;           // [s] of the longest render of each variant
    std::string times;                      // [s], by commas; empty: by `budget`
    uint32_t seeds = 3;
    std::filesystem::path folder;
    std::string command;
};

// Renders what is not in the folder yet. Where `stop` says so the result is of the seeds that were
// done. Variants that cannot be rendered are left out, with a warning. Throws Interrupted where not
// one seed was done, and Error as `render` does where no variant is left.
ChartResult run_chart(
    const ChartOptions& options,
    const RenderJob& job,
    const std::vector<Variant>& variants,
    const Devices& devices,
    const std::function<bool()>& stop);

}  // namespace wavepath
