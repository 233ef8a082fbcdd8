#include "commands/outputs.h"

#include "commands/interrupt.h"
#include "commands/progress.h"
#include "error.h"
#include "film/atomic_file.h"
#include "film/exr_writer.h"
#include "film/png_writer.h"
#include "measure/report.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>

namespace wavepath {

namespace {

bool is_picture(const std::filesystem::path& path) {
    return path.extension() == ".exr" || path.extension() == ".png";
}

std::filesystem::path real_path(const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
}

// Inputs and outputs are files of their own, however their names are spelled.
void check_distinct(const RenderOptions& options, const Outputs& outputs) {
    std::vector<std::filesystem::path> names = outputs.images;
    for (const auto& path : {outputs.json, options.scene, options.environment})
        if (!path.empty()) names.push_back(path);
    std::map<std::filesystem::path, std::filesystem::path> known;
    for (const auto& name : names) {
        const auto [other, is_new] = known.try_emplace(real_path(name), name);
        if (!is_new)
            throw Error("{} and {} are one file; name two", other->second.string(), name.string());
    }
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

}  // namespace

void add_output_options(CLI::App& app, Outputs& outputs) {
    const std::string usual = outputs.images.empty() ? "none" : outputs.images.front().string();
    app.add_option(
           "-o,--output", outputs.images,
           "Pictures to write, .exr (all layers) or .png; default " + usual)
        ->check([](const std::string& name) {
            if (is_picture(name)) return std::string();
            return fmt::format(
                "\"{}\": pictures end in .exr or .png; a scene stands before -o or behind --",
                name);
        })
        ->type_name("FILE");
    app.add_option("--exposure", outputs.exposure, "Of the PNG: scales by 2^EV")->type_name("EV");
    app.add_option("--json", outputs.json, "Write a report of the render")->type_name("FILE");
    app.add_flag("--quiet", outputs.quiet, "Say nothing on the way but warnings and errors");
}

void check_outputs(const RenderOptions& options, const Outputs& outputs) {
    check_distinct(options, outputs);
    for (const auto& path : outputs.images) check_writable(path);
    if (!outputs.json.empty()) check_writable(outputs.json);
    if (!(std::abs(outputs.exposure) <= 100))
        throw Error("--exposure {}: use stops between -100 and 100", outputs.exposure);
}

void check_outputs_spare(const Scene& scene, const Outputs& outputs) {
    std::vector<std::filesystem::path> names = outputs.images;
    if (!outputs.json.empty()) names.push_back(outputs.json);
    for (const auto& name : names)
        if (std::ranges::find(scene.files, real_path(name), real_path) != scene.files.end())
            throw Error(
                "{}: belongs to {}; choose another name for the output", name.string(), scene.name);
}

void write_outputs(
    const Device& device, const RenderJob& job, RenderResult& result, const Outputs& outputs) {
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
    if (!result.interrupted) return;
    spdlog::warn("interrupted: there are {} samples a pixel", result.samples);
    throw Interrupted();
}

}  // namespace wavepath
