#include "commands/run_job.h"

#include "commands/interrupt.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "device/driver_failure.h"

#include <spdlog/spdlog.h>

#include <system_error>

namespace wavepath {

namespace {

// What is ignored and what went wrong is said. Throws Interrupted if a signal to stop comes before
// every pixel has a sample; later it sets the result's `interrupted`.
RenderResult render_watched(const Device& device, const RenderJob& job, bool quiet) {
    for (const std::string& line : job.scene.ignored) spdlog::warn("{}: {}", job.scene.name, line);
    spdlog::info(
        "{}: {} triangles, {}x{}, {} on {}; its kernels take some seconds where they are new",
        job.scene.name, job.scene.triangle_count(), job.settings.width, job.settings.height,
        job.settings.method.name, device.info.name);

    const InterruptGuard interrupt;
    const DriverFailureGuard driver;
    Progress progress(job.settings, quiet);
    RenderResult result = render(
        device, job.scene, job.settings, [&](const RenderProgress& state) { progress.show(state); },
        [&] { return interrupt.requested(); });
    progress.finish();
    if (result.samples == 0) {
        spdlog::warn("interrupted before every pixel had a sample: nothing is written");
        throw Interrupted{interrupt_signal()};
    }
    for (const std::string& warning : result.warnings) spdlog::warn("{}", warning);
    const std::vector<std::string>& ignored = job.scene.ignored;  // said before the render
    result.warnings.insert(result.warnings.begin(), ignored.begin(), ignored.end());
    if (result.film.nonfinite.samples > 0)
        spdlog::warn(
            "{} samples were not finite, the first in pixel ({}, {}), sample {}; their pixels hold "
            "NaN or infinity",
            result.film.nonfinite.samples, result.film.nonfinite.x, result.film.nonfinite.y,
            result.film.nonfinite.sample);
    if (result.cut_paths.count > 0)
        spdlog::warn(
            "{} cut after {} scatterings, the first in pixel ({}, {}), sample {}: their further "
            "light is missing; use --termination roulette or roulette:q, which are unbiased, or "
            "depth:D, which is biased",
            result.cut_paths.count == 1 ? "1 path was"
                                        : fmt::format("{} paths were", result.cut_paths.count),
            MAX_SCATTERINGS, result.cut_paths.x, result.cut_paths.y, result.cut_paths.sample);
    return result;
}

}  // namespace

void run_job(const RenderOptions& options, Outputs outputs, const Inspect& inspect) {
    prepare_signals();
    if (outputs.quiet) spdlog::set_level(spdlog::level::warn);
    check_outputs(outputs);
    check_apart(outputs, {options.scene, options.environment});
    const Device device = open_device(options.device);
    const RenderJob job = prepare_job(options);
    check_apart(outputs, job.scene.files);
    RenderResult result = render_watched(device, job, outputs.quiet);
    nlohmann::ordered_json report = render_report(device, job, result);
    try {
        if (inspect) inspect(device, job, result, report);
    } catch (const std::system_error&) {
        // The pictures come first; that standard output failed is main's to say.
    }
    write_outputs(device, job, result, outputs, std::move(report));
}

}  // namespace wavepath
