#include "commands/run_job.h"

#include "commands/interrupt.h"
#include "commands/progress.h"
#include "device/driver_failure.h"

#include <spdlog/spdlog.h>

namespace wavepath {

RenderResult run_job(const Device& device, const RenderJob& job, bool quiet) {
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

}  // namespace wavepath
