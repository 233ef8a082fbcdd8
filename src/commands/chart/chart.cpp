#include "commands/chart/chart.h"

#include "commands/chart/chart_run.h"
#include "commands/interrupt.h"
#include "commands/output_folder.h"
#include "commands/shell_word.h"
#include "device/driver_failure.h"
#include "error.h"
#include "page/chart.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>

namespace wavepath {

namespace {

void add_options(CLI::App& app, ChartOptions& o) {
    const auto add = [&](const std::string& name, auto& value, const std::string& type,
                         const std::string& text) {
        return app.add_option(name, value, text)->type_name(type)->group("Chart");
    };
    add("-o,--output", o.folder, "DIR", "Where chart.html, its numbers and all pictures go")
        ->required();
    add("--methods", o.methods, "LIST",
        "What to compare: methods by commas, each with options of how to compute behind it; "
        "default " +
            o.methods);
    add("--budget", o.budget, "SECONDS",
        "Time of the longest render of each; default 4. --spp N instead: N samples of each")
        ->check(CLI::PositiveNumber);
    add("--times", o.times, "S,S,...", "Times of the renders of each instead [s]");
    add("--seeds", o.seeds, "K", "Renders of each point; default 3")->check(CLI::Range(2, 1000));
    add("--reference", o.reference, "REF.exr", "The truth; default two halves, rendered");
    add("--reference-spp", o.reference_spp, "N",
        "Samples of each half; default 4 times the most of any render")
        ->check(CLI::Range(int64_t{1}, int64_t{0xFFFFFFFF}));
}

// The options of `app` that were given.
std::string given_options(const CLI::App& app) {
    std::string text;
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0) continue;
        if (!option->get_positional()) text += fmt::format(" {}", option->get_name());
        for (const std::string& value : option->results())
            text += fmt::format(" {}", shell_word(value));
    }
    return text;
}

void check_options(const CLI::App& app, const ChartOptions& options) {
    if (options.render.time || options.render.target_error)
        throw Error("--time and --target-error: give --budget, --times or --spp to a chart");
    if (int{options.render.spp.has_value()} + int{options.budget.has_value()} +
            int{!options.times.empty()} >
        1)
        throw Error("--spp, --budget and --times: give one of them");
    for (const char* name : {"--method", "--seed"})
        if (app.count(name) > 0)
            throw Error("{}: a chart takes --methods, and seeds from 1 to --seeds", name);
}

void chart(const CLI::App& app, ChartOptions& options) {
    prepare_signals();
    check_options(app, options);
    check_gnuplot();
    make_output_folder(options.folder, "chart.html");
    options.command = "wavepath chart" + given_options(app);
    const RenderJob job = prepare_job(options.render);
    for (const std::string& line : job.scene.ignored) spdlog::warn("{}: {}", job.scene.name, line);
    const std::vector<Variant> variants = parse_variants(options.methods, options.render, job);
    const Devices devices = open_devices(variants, options.render.device);
    ChartResult result;
    {
        const InterruptGuard interrupt;
        const DriverFailureGuard driver;
        result = run_chart(options, job, variants, devices, [&] { return interrupt.requested(); });
    }
    write_chart(result, options.folder);
    spdlog::info("wrote {}", (options.folder / "chart.html").string());
    if (result.interrupted) throw Interrupted{interrupt_signal()};
}

}  // namespace

void add_chart_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("chart", "Chart error against time, setting by setting");
    const auto options = std::make_shared<ChartOptions>();
    add_render_options(*command, options->render);
    add_options(*command, *options);
    command->callback([command, options] { chart(*command, *options); });
}

}  // namespace wavepath
