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
    std::string render_command;  // of one render, without what decides the variant
    std::string chart_command;
};

// Renders what is not in the folder yet. Where `stop` says so the result is of the seeds that were
// done. Throws Interrupted where not one was, and Error as `render` does.
ChartResult run_chart(
    const ChartOptions& options, const RenderJob& job, const std::function<bool()>& stop);

}  // namespace wavepath
