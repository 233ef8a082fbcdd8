#include "commands/outputs.h"

#include "commands/interrupt.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "error.h"
#include "film/auto_exposure.h"
#include "image/atomic_file.h"
#include "image/exr_writer.h"
#include "image/png_writer.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace wavepath {

namespace {

bool is_picture(const std::filesystem::path& path) {
    return path.extension() == ".exr" || path.extension() == ".png";
}

// However their names are spelled or linked; of files that are not there yet the names decide.
bool one_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code failure;
    if (std::filesystem::equivalent(a, b, failure)) return true;
    const auto real_a = std::filesystem::weakly_canonical(std::filesystem::absolute(a), failure);
    if (failure) return false;
    return real_a == std::filesystem::weakly_canonical(std::filesystem::absolute(b), failure);
}

std::vector<std::filesystem::path> files_of(const Outputs& outputs) {
    std::vector<std::filesystem::path> files = outputs.images;
    if (!outputs.json.empty()) files.push_back(outputs.json);
    return files;
}

// The report's bytes; names of files need not be UTF-8.
std::string text_of(const nlohmann::json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

// [stops]; none: auto.
std::optional<double> fixed_exposure(const Outputs& outputs) {
    if (outputs.exposure == "auto") return std::nullopt;
    const char* const end = outputs.exposure.data() + outputs.exposure.size();
    const char* const digits =
        outputs.exposure.data() + (outputs.exposure.starts_with('+') ? 1 : 0);
    double stops = 0;
    const auto [rest, error] = std::from_chars(digits, end, stops);
    if (error != std::errc{} || rest != end || !(std::abs(stops) <= 100))
        throw Error("--exposure {}: use stops between -100 and 100, or auto", outputs.exposure);
    return stops;
}

std::map<std::string, std::string> metadata(
    const Device& device, const RenderJob& job, const RenderResult& result) {
    const std::string bias = bias_of(job.settings, result);
    nlohmann::ordered_json settings = settings_report(job);
    settings.erase("pool");  // decides no picture, so no byte of one either
    std::map<std::string, std::string> m{
        {"wavepath.scene", job.scene.name},
        {"wavepath.camera", job.settings.camera.name},
        {"wavepath.seed", std::to_string(job.settings.seed)},
        {"wavepath.samples", std::to_string(result.samples)},
        {"wavepath.method", job.settings.method.name},
        {"wavepath.termination", job.settings.termination.text()},
        {"wavepath.layering", job.settings.layers_conserve ? "conserving" : "specification"},
        {"wavepath.bias", bias.empty() ? "none" : bias},
        {"wavepath.variance_batches", std::to_string(result.batches)},
        {"wavepath.device", device.info.platform + ", " + device.info.name},
        {"wavepath.driver", device.info.driver},
        {"wavepath.build", build_text()},
        {"wavepath.settings", text_of(settings, -1)},
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
        ->type_name("FILE")
        ->group("Output");
    app.add_option(
           "--exposure", outputs.exposure,
           "Of the PNG: scales by 2^EV; auto: so that its mean brightness is middle grey; default "
           "0")
        ->type_name("EV|auto")
        ->group("Output");
    app.add_option("--json", outputs.json, "Write a report of the render")
        ->type_name("FILE")
        ->group("Output");
    app.add_flag("--quiet", outputs.quiet, "Say nothing on the way but warnings and errors")
        ->group("Output");
}

void check_outputs(Outputs& outputs) {
    fixed_exposure(outputs);
    std::vector<std::string> reasons;
    const auto is_lost = [&](const std::filesystem::path& output) {
        try {
            check_writable(output);
            return false;
        } catch (const Error& error) {
            reasons.emplace_back(error.what());
            return true;
        }
    };
    const bool wants_pictures = !outputs.images.empty();
    std::erase_if(outputs.images, is_lost);
    if (!outputs.json.empty() && is_lost(outputs.json)) outputs.json.clear();
    if (reasons.empty()) return;
    if (outputs.images.empty() && (wants_pictures || outputs.json.empty()))
        throw Error("{}", reasons.front());
    for (const std::string& reason : reasons) spdlog::error("{}", reason);
    outputs.lacks_some = true;
}

void check_apart(const Outputs& outputs, std::vector<std::filesystem::path> inputs) {
    for (const auto& output : files_of(outputs)) {
        for (const auto& other : inputs) {
            if (!other.empty() && one_file(output, other))
                throw Error("{} and {} are one file; name two", output.string(), other.string());
        }
        inputs.push_back(output);
    }
}

void write_outputs(
    const Device& device,
    const RenderJob& job,
    RenderResult& result,
    const Outputs& outputs,
    nlohmann::ordered_json report) {
    const Image& image = result.film.image;
    result.film.image.metadata = metadata(device, job, result);
    const auto fixed = fixed_exposure(outputs);
    const double exposure = fixed ? *fixed : auto_exposure(image);
    if (!fixed) spdlog::info("--exposure auto is {} EV", exposure);
    bool failed = outputs.lacks_some;
    const auto attempt = [&](const auto& write) {
        try {
            write();
        } catch (const std::exception& error) {
            spdlog::error("{}", error.what());
            failed = true;
        }
    };
    for (const auto& path : outputs.images)
        attempt([&] {
            if (path.extension() == ".exr")
                write_exr(image, path);
            else
                write_png(image, path, exposure);
            spdlog::info(
                "wrote {}: {} samples a pixel in {:.2f} s, relative error {}", path.string(),
                result.samples, result.times.render,
                relative_error_text(result.film.relative_error));
        });
    if (!outputs.json.empty())
        attempt([&] {
            report["exposure_ev"] = exposure;
            AtomicFile(outputs.json).commit(text_of(report, 2) + "\n");
        });
    if (result.interrupted)
        spdlog::warn("interrupted: there are {} samples a pixel", result.samples);
    if (failed) throw OutputFailed();
    if (result.interrupted) throw Interrupted{interrupt_signal()};
    if (result.cut_paths.count > 0) throw PathsCut();
}

}  // namespace wavepath
