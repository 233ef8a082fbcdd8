#include "commands/render.h"

#include "commands/interrupt.h"
#include "commands/progress.h"
#include "commands/run_job.h"
#include "device/device.h"
#include "error.h"
#include "film/atomic_file.h"
#include "film/exr_writer.h"
#include "film/png_writer.h"
#include "measure/report.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>

namespace wavepath {

namespace {

struct Outputs {
    std::vector<std::filesystem::path> images{"wavepath.exr"};
    double exposure = 0;
    std::filesystem::path json;
    bool quiet = false;
};

// Inputs and outputs are files of their own, however their names are spelled.
void check_distinct(const RenderOptions& options, const Outputs& outputs) {
    std::vector<std::filesystem::path> names = outputs.images;
    for (const auto& path : {outputs.json, options.scene, options.environment})
        if (!path.empty()) names.push_back(path);
    std::map<std::filesystem::path, std::filesystem::path> known;
    for (const auto& name : names) {
        const auto [other, is_new] = known.try_emplace(
            std::filesystem::weakly_canonical(std::filesystem::absolute(name)), name);
        if (!is_new)
            throw Error("{} and {} are one file; name two", other->second.string(), name.string());
    }
}

void check_outputs(const RenderOptions& options, const Outputs& outputs) {
    for (const auto& path : outputs.images)
        if (path.extension() != ".exr" && path.extension() != ".png")
            throw Error("\"{}\": pictures end in .exr or .png; choose one", path.string());
    check_distinct(options, outputs);
    for (const auto& path : outputs.images) check_writable(path);
    if (!outputs.json.empty()) check_writable(outputs.json);
    if (!(std::abs(outputs.exposure) <= 100))
        throw Error("--exposure {}: use stops between -100 and 100", outputs.exposure);
}

std::map<std::string, std::string> metadata(
    const Device& device, const RenderJob& job, const RenderResult& result) {
    const std::string bias = job.settings.bias();
    std::map<std::string, std::string> m{
        {"wavepath.scene", job.scene.name},
        {"wavepath.camera", job.settings.camera.name},
        {"wavepath.seed", std::to_string(job.settings.seed)},
        {"wavepath.samples", std::to_string(result.samples)},
        {"wavepath.method", job.settings.method.name},
        {"wavepath.termination", job.settings.termination.text()},
        {"wavepath.bias", bias.empty() ? "none" : bias},
        {"wavepath.variance_batches", std::to_string(result.batches)},
        {"wavepath.device", device.info.platform + ", " + device.info.name},
        {"wavepath.driver", device.info.driver},
        {"wavepath.build", build_text()},
        {"wavepath.settings", settings_report(job).dump()},
    };
    for (const std::string& warning : result.warnings) m["wavepath.warning"] += warning + "\n";
    return m;
}

void run(const RenderOptions& options, const Outputs& outputs) {
    if (outputs.quiet) spdlog::set_level(spdlog::level::warn);
    check_outputs(options, outputs);
    const Device device = open_device(options.device);
    const RenderJob job = prepare_job(options);
    RenderResult result = run_job(device, job, outputs.quiet);
    result.film.image.metadata = metadata(device, job, result);
    for (const auto& path : outputs.images) {
        if (path.extension() == ".exr")
            write_exr(result.film.image, path);
        else
            write_png(result.film.image, path, outputs.exposure);
        spdlog::info(
            "wrote {}: {} samples a pixel in {:.2f} s, relative error {}", path.string(),
            result.samples, result.times.render, relative_error_text(result.film.relative_error));
    }
    if (!outputs.json.empty())
        AtomicFile(outputs.json).commit(render_report(device, job, result).dump(2) + "\n");
    if (result.interrupted) {
        spdlog::warn("interrupted: the picture holds {} samples a pixel", result.samples);
        throw Interrupted();
    }
}

}  // namespace

void add_render_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Render a glTF scene to OpenEXR or PNG");
    const auto options = std::make_shared<RenderOptions>();
    const auto outputs = std::make_shared<Outputs>();
    add_render_options(*command, *options);
    command
        ->add_option(
            "-o,--output", outputs->images,
            "Pictures to write, .exr (all layers) or .png; default wavepath.exr")
        ->type_name("FILE");
    command->add_option("--exposure", outputs->exposure, "Of the PNG: scales by 2^EV")
        ->type_name("EV");
    command->add_option("--json", outputs->json, "Write a report of the render")->type_name("FILE");
    command->add_flag("--quiet", outputs->quiet, "Say nothing but warnings and errors");
    command->callback([options, outputs] { run(*options, *outputs); });
}

}  // namespace wavepath
