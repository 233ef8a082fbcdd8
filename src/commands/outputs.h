// What a render leaves behind: pictures and a report.
#pragma once

#include "commands/render_options.h"

namespace wavepath {

struct Outputs {
    std::vector<std::filesystem::path> images;
    double exposure = 0;  // [stops] of PNG
    std::filesystem::path json;
    bool quiet = false;
};

// Options for `outputs`, whose values beforehand are the defaults.
void add_output_options(CLI::App& app, Outputs& outputs);

// Throws Error, before any work is done, for a file that can't be written, or that is another
// output or an input as well.
void check_outputs(const RenderOptions& options, const Outputs& outputs);

// Throws Error for an output that is one of the files that the scene was read from.
void check_outputs_spare(const Scene& scene, const Outputs& outputs);

// Throws Interrupted at the end if Ctrl-C stopped the render.
void write_outputs(
    const Device& device, const RenderJob& job, RenderResult& result, const Outputs& outputs);

}  // namespace wavepath
