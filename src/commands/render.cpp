#include "commands/render.h"

#include "commands/interrupt.h"
#include "commands/outputs.h"
#include "commands/run_job.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>

namespace wavepath {

namespace {

void run(const RenderOptions& options, const Outputs& outputs) {
    prepare_signals();
    if (outputs.quiet) spdlog::set_level(spdlog::level::warn);
    check_outputs(outputs);
    check_apart(outputs, {options.scene, options.environment});
    const Device device = open_device(options.device);
    const RenderJob job = prepare_job(options);
    check_apart(outputs, job.scene.files);
    RenderResult result = run_job(device, job, outputs.quiet);
    write_outputs(device, job, result, outputs);
}

}  // namespace

void add_render_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Render a glTF scene to OpenEXR or PNG");
    const auto options = std::make_shared<RenderOptions>();
    const auto outputs = std::make_shared<Outputs>();
    outputs->images = {"wavepath.exr"};
    add_render_options(*command, *options);
    add_output_options(*command, *outputs);
    command->callback([options, outputs] { run(*options, *outputs); });
}

}  // namespace wavepath
