#include "commands/render.h"

#include "commands/outputs.h"
#include "commands/run_job.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace wavepath {

void add_render_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Render a glTF scene to OpenEXR or PNG");
    const auto options = std::make_shared<RenderOptions>();
    const auto outputs = std::make_shared<Outputs>();
    outputs->images = {"wavepath.exr"};
    add_render_options(*command, *options);
    add_output_options(*command, *outputs);
    command->callback([options, outputs] { run_job(*options, *outputs); });
}

}  // namespace wavepath
