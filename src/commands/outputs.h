// What a render leaves behind: pictures and a report.
#pragma once

#include "commands/render_job.h"

#include <nlohmann/json_fwd.hpp>

#include <nlohmann/json_fwd.hpp>

namespace wavepath {

// Thrown when the reasons have been said; main answers with exit status 1.
struct OutputFailed {};

struct Outputs {
    std::vector<std::filesystem::path> images;
    std::string exposure = "0";  // of PNG: stops, or "auto"
    std::filesystem::path json;
    std::filesystem::path trace;  // the timeline; asks for one to be kept
    bool quiet = false;
    bool lacks_some = false;  // that check_outputs has taken out
};

// Options for `outputs`, whose values beforehand are the defaults: for pictures and the report, and
// for the report alone.
void add_output_options(CLI::App& app, Outputs& outputs);
void add_report_options(CLI::App& app, Outputs& outputs);

// Says in a line each which outputs can't be written, and takes them out. Throws Error where no
// picture would be left, or, without pictures, no report.
void check_outputs(Outputs& outputs);

// Throws Error for an output that is one of the inputs, or that is named twice.
void check_apart(const Outputs& outputs, std::vector<std::filesystem::path> inputs);

// Thrown when pictures have been written in which paths were cut; main answers with exit status 2.
struct PathsCut {};

// Writes what can be written and says in a line each what cannot. Throws OutputFailed at the end if
// there was any such, else Interrupted if a signal stopped the render, else PathsCut if paths were
// cut. `report`: what --json gets, without `exposure_ev`.
void write_outputs(
    const Device& device,
    const RenderJob& job,
    RenderResult& result,
    const Outputs& outputs,
    nlohmann::ordered_json report);

}  // namespace wavepath
