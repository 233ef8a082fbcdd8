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

// Throws Error for an output that can't be written.
void check_outputs(const Outputs& outputs);

// Throws Error for an output that is one of the inputs, or that is named twice.
void check_apart(const Outputs& outputs, std::vector<std::filesystem::path> inputs);

// Throws Interrupted at the end if Ctrl-C stopped the render.
void write_outputs(
    const Device& device, const RenderJob& job, RenderResult& result, const Outputs& outputs);

}  // namespace wavepath
