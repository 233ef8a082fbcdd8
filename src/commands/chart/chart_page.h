// A chart as a page, as JSON and as CSV.
#pragma once

#include "commands/chart/measurement.h"

#include <filesystem>
#include <string>
#include <vector>

namespace wavepath {

// One picture a variant, of about the same time.
struct ChartPicture {
    std::size_t variant = 0;
    uint64_t samples = 0;
    double seconds = 0;
    Image image;
};

struct ChartResult {
    std::string scene, device, command;
    uint32_t width = 0, height = 0, seeds = 0;
    Reference reference;
    std::vector<VariantCurve> curves;
    std::vector<ChartPicture> pictures;
    bool interrupted = false;  // what there is, is shown
};

// Writes chart.html, chart.json, chart.csv and the pictures into `folder` (docs/chart.md says what
// is in them).
void write_chart(const ChartResult& result, const std::filesystem::path& folder);

}  // namespace wavepath
