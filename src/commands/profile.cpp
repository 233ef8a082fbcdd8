#include "commands/profile.h"

#include "commands/baselines.h"
#include "commands/interrupt.h"
#include "commands/output_folder.h"
#include "commands/outputs.h"
#include "commands/profile_page.h"
#include "commands/profile_tables.h"
#include "commands/run_job.h"
#include "error.h"
#include "image/exr_writer.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>

namespace wavepath {

namespace {

std::string title_of(const Device& device, const RenderJob& job, const RenderResult& result) {
    return fmt::format(
        "{}: {} triangles, {}x{}, {} samples a pixel, {}, {} on {}, {}", job.scene.name,
        result.triangles, job.settings.width, job.settings.height, result.samples,
        job.settings.method.name, job.settings.termination.text(), device.info.platform,
        device.info.name);
}

void print_totals(const RenderJob& job, const RenderResult& result) {
    const double samples =
        static_cast<double>(result.samples) * job.settings.width * job.settings.height;
    fmt::print(
        "closest hits {}, connections {}, {:.2f} Mrays/s\n\n"
        "{:.2f} Msamples/s; load {:.0f} ms, BVH {:.0f} ms, upload {:.0f} ms, program {:.0f} ms, "
        "render {:.0f} ms\n",
        result.rays.closest, result.rays.connections,
        1e-6 * static_cast<double>(result.rays.closest + result.rays.connections) /
            result.times.render,
        1e-6 * samples / result.times.render, 1e3 * job.load_seconds, 1e3 * result.times.bvh_build,
        1e3 * result.times.upload, 1e3 * result.times.program_build, 1e3 * result.times.render);
    fmt::print(
        "device memory: scene {:.1f} MiB ({:.0f} bytes a triangle), pool {:.1f} MiB, film {:.1f} "
        "MiB\n",
        static_cast<double>(result.scene_bytes) / 1048576.0,
        static_cast<double>(result.scene_bytes) / static_cast<double>(result.triangles),
        static_cast<double>(result.pool_bytes) / 1048576.0,
        static_cast<double>(result.film_bytes) / 1048576.0);
}

void print_profile(const RenderJob& job, const RenderResult& result, const Roofline& roofline) {
    fmt::print("{}", text_of(kernel_table(result)));
    if (!result.device_clock)
        fmt::print(
            "this driver returns no times for kernels: the rows above are empty, host time stands "
            "in\n");
    fmt::print("\n{}\n{}", peaks_sentence(roofline), text_of(roofline_table(roofline)));
    fmt::print("\n{}\n{}", build_sentence(result.program), text_of(build_table(result.program)));
    fmt::print("\n{}", text_of(depth_table(result.rays)));
    print_totals(job, result);
}

// `folder`: where the page goes; empty: there is none.
void run_profile(
    const RenderOptions& options,
    Outputs outputs,
    const std::filesystem::path& folder,
    const std::vector<std::string>& against) {
    const std::vector<Baseline> baselines = open_baselines(against, options);
    const std::filesystem::path page = folder / "page.html";
    if (!folder.empty()) {
        check_gnuplot();
        make_output_folder(folder, "page.html");
        if (outputs.json.empty()) outputs.json = folder / "profile.json";
        if (outputs.trace.empty()) outputs.trace = folder / "trace.json";
    }
    run_job(
        options, outputs,
        [&](const Device& device, const RenderJob& job, const RenderResult& result,
            nlohmann::ordered_json& report) {
            const Roofline roofline = roofline_of(result, measure_peaks(device));
            report["roofline"] = roofline_report(roofline);
            const std::string title = title_of(device, job, result);
            if (!folder.empty()) {
                write_profile_page(page, title, result, roofline);
                spdlog::info("wrote {}", page.string());
            }
            fmt::print("{}\n\n", title);
            print_profile(job, result, roofline);
            if (!baselines.empty() && !result.interrupted)
                report["baselines"] = compare_with(baselines, device, job, result);
        });
    // In the comparison: the render's own interruption has been thrown.
    if (interrupt_signal() != 0) throw Interrupted{interrupt_signal()};
}

}  // namespace

void add_profile_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("profile", "Time every kernel of a render");
    const auto options = std::make_shared<RenderOptions>();
    const auto outputs = std::make_shared<Outputs>();
    const auto against = std::make_shared<std::vector<std::string>>();
    const auto folder = std::make_shared<std::filesystem::path>();
    add_render_options(*command, *options);
    command
        ->add_option(
            "-o,--output", *folder,
            "Folder for page.html, with charts, profile.json and trace.json")
        ->type_name("DIR")
        ->group("Output");
    add_report_options(*command, *outputs);
    add_baseline_options(*command, *against);
    command
        ->add_option(
            "--trace", outputs->trace, "Write the timeline of every launch, for ui.perfetto.dev")
        ->type_name("FILE")
        ->group("Output");
    command->callback([options, outputs, folder, against] {
        run_profile(*options, *outputs, *folder, *against);
    });
}

}  // namespace wavepath
