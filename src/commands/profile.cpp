#include "commands/profile.h"

#include "commands/baselines.h"
#include "commands/interrupt.h"
#include "commands/outputs.h"
#include "commands/run_job.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

namespace wavepath {

namespace {

void print_kernels(const RenderResult& result) {
    std::vector<ProfileRow> rows = result.profile;
    std::ranges::sort(rows, std::greater{}, &ProfileRow::seconds);
    fmt::print(
        "{:<18}{:>10}{:>14}{:>12}{:>8}{:>12}{:>12}\n", "kernel", "launches", "items", "ms", "share",
        "ns/item", "Mitems/s");
    double kernels = 0;
    for (const ProfileRow& row : rows) {
        kernels += row.seconds;
        const auto items = static_cast<double>(std::max<uint64_t>(row.items, 1));
        fmt::print(
            "{:<18}{:>10}{:>14}{:>12.2f}{:>7.1f}%{:>12.2f}{:>12.2f}\n", row.name, row.launches,
            row.items, 1e3 * row.seconds, 100 * row.seconds / result.times.render,
            1e9 * row.seconds / items, row.seconds > 0 ? 1e-6 * items / row.seconds : 0);
    }
    const double outside = result.times.render - kernels;
    fmt::print(
        "{:<18}{:>36.2f}{:>7.1f}%  launches, readbacks, host\n", "outside kernels", 1e3 * outside,
        100 * outside / result.times.render);
    if (!result.device_clock)
        fmt::print(
            "this driver returns no times for kernels: the rows above are empty, host time stands "
            "in\n");
}

void print_rays(const RenderResult& result) {
    fmt::print("\nrays per depth (closest hit)\n");
    uint64_t alive = 0;
    for (const uint64_t n : result.rays.path_lengths) alive += n;
    for (std::size_t depth = 0; depth < result.rays.path_lengths.size() && alive > 0; ++depth) {
        fmt::print(
            "{:>5}{}{:>14}\n", depth, depth + 1 == result.rays.path_lengths.size() ? "+" : " ",
            alive);
        alive -= result.rays.path_lengths[depth];
    }
    fmt::print(
        "closest hits {}, connections {}, {:.2f} Mrays/s\n", result.rays.closest,
        result.rays.connections,
        1e-6 * static_cast<double>(result.rays.closest + result.rays.connections) /
            result.times.render);
}

void print_profile(const Device& device, const RenderJob& job, const RenderResult& result) {
    const double samples =
        static_cast<double>(result.samples) * job.settings.width * job.settings.height;
    fmt::print(
        "{}: {} triangles, {}x{}, {} samples a pixel, {}, {} on {}, {}\n\n", job.scene.name,
        result.triangles, job.settings.width, job.settings.height, result.samples,
        job.settings.method.name, job.settings.termination.text(), device.info.platform,
        device.info.name);
    print_kernels(result);
    print_rays(result);
    fmt::print(
        "\n{:.2f} Msamples/s; load {:.0f} ms, BVH {:.0f} ms, upload {:.0f} ms, program {:.0f} ms "
        "({}), render {:.0f} ms\n",
        1e-6 * samples / result.times.render, 1e3 * job.load_seconds, 1e3 * result.times.bvh_build,
        1e3 * result.times.upload, 1e3 * result.times.program_build,
        result.program.from_cache ? "from our cache" : "built, or from the driver's cache",
        1e3 * result.times.render);
    fmt::print(
        "device memory: scene {:.1f} MiB ({:.0f} bytes a triangle), pool {:.1f} MiB, film {:.1f} "
        "MiB\n",
        static_cast<double>(result.scene_bytes) / 1048576.0,
        static_cast<double>(result.scene_bytes) / static_cast<double>(result.triangles),
        static_cast<double>(result.pool_bytes) / 1048576.0,
        static_cast<double>(result.film_bytes) / 1048576.0);
}

}  // namespace

void add_profile_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("profile", "Time every kernel of a render");
    const auto options = std::make_shared<RenderOptions>();
    const auto outputs = std::make_shared<Outputs>();
    const auto against = std::make_shared<std::vector<std::string>>();
    add_render_options(*command, *options);
    add_output_options(*command, *outputs);
    add_baseline_options(*command, *against);
    command->callback([options, outputs, against] {
        const std::vector<Baseline> baselines = open_baselines(*against, *options);
        run_job(
            *options, *outputs,
            [&](const Device& device, const RenderJob& job, const RenderResult& result,
                nlohmann::ordered_json& report) {
                print_profile(device, job, result);
                if (!baselines.empty() && !result.interrupted)
                    report["baselines"] = compare_with(baselines, device, job, result);
            });
        // In the comparison: the render's own interruption has been thrown.
        if (interrupt_signal() != 0) throw Interrupted{interrupt_signal()};
    });
}

}  // namespace wavepath
