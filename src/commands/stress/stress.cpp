#include "commands/stress/stress.h"

#include "commands/interrupt.h"
#include "commands/json_text.h"
#include "commands/output_folder.h"
#include "commands/stress/matrix.h"
#include "device/device.h"
#include "device/driver_failure.h"
#include "error.h"
#include "image/atomic_file.h"
#include "page/chart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

namespace wavepath {

namespace {

struct StressOptions {
    bool quick = false;
    std::vector<std::string> methods;  // none: all
    std::string device;
    std::filesystem::path folder;
};

std::vector<Situation> all_situations(Effort effort) {
    std::vector<Situation> all;
    for (const auto& family :
         {light_situations, furnace_situations, medium_situations, lobe_situations,
          place_situations})
        for (Situation& situation : family(effort)) all.push_back(std::move(situation));
    return all;
}

// Throws Error for a method that no situation has.
void keep_methods(std::vector<Situation>& situations, const std::vector<std::string>& methods) {
    if (methods.empty()) return;
    std::set<std::string> known;
    for (const Situation& situation : situations) known.insert(situation.method);
    for (const std::string& method : methods)
        if (!known.contains(method))
            throw Error("--methods {}: no column; use some of {}", method, fmt::join(known, ", "));
    std::erase_if(situations, [&](const Situation& situation) {
        return std::ranges::find(methods, situation.method) == methods.end();
    });
}

// A signal to stop is heeded after the cell in which it comes.
std::vector<Cell> judge_all(const Device& device, std::vector<Situation> situations) {
    const InterruptGuard interrupt;
    const DriverFailureGuard driver;
    std::vector<Cell> cells;
    for (Situation& situation : situations) {
        if (interrupt.requested()) break;
        const Judgement judgement = judge(device, situation);
        situation.scene = {};
        cells.push_back({std::move(situation), judgement});
        const Cell& cell = cells.back();
        spdlog::info(
            "{} of {}: {}, {} {:g}, {}: {}", cells.size(), situations.size(), cell.situation.family,
            cell.situation.abscissa, cell.situation.x, cell.situation.method,
            name_of(cell.judgement.verdict));
    }
    return cells;
}

void run_stress(const StressOptions& options) {
    prepare_signals();
    check_gnuplot();
    std::vector<Situation> situations =
        all_situations(options.quick ? Effort::quick : Effort::whole);
    keep_methods(situations, options.methods);
    make_output_folder(options.folder, "index.html");
    const Device device = open_device(options.device);
    const std::string device_name = device.info.platform + ", " + device.info.name;
    const std::vector<Cell> cells = judge_all(device, std::move(situations));
    if (cells.empty()) throw Interrupted{interrupt_signal()};
    AtomicFile(options.folder / "stress.json")
        .commit(json_text(json_of(cells, device_name), 2) + "\n");
    write_matrix(cells, device_name, options.folder);

    std::size_t unexpected = 0;
    for (const Cell& cell : cells) {
        if (cell.as_expected()) continue;
        ++unexpected;
        fmt::print(
            "{}, {} {:g}, {}: {}, expected: {}; {}\n", cell.situation.family,
            cell.situation.abscissa, cell.situation.x, cell.situation.method,
            name_of(cell.judgement.verdict), name_of(cell.situation.expected), words_of(cell));
    }
    fmt::print("{} cells, {} as expected\n", cells.size(), cells.size() - unexpected);
    if (unexpected > 0)
        throw Error(
            "{} of {} verdicts differ from those expected; see {}", unexpected, cells.size(),
            (options.folder / "index.html").string());
    if (interrupt_signal() != 0) throw Interrupted{interrupt_signal()};
}

}  // namespace

void add_stress_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "stress", "Show where each estimator lives and dies, against closed forms");
    const auto options = std::make_shared<StressOptions>();
    command
        ->add_option("-o,--output", options->folder, "Where the page and stress.json are written")
        ->required()
        ->type_name("DIR");
    command->add_flag("--quick", options->quick, "2^16 samples a cell instead of 2^20");
    command
        ->add_option(
            "--methods", options->methods,
            "Columns of the matrices to fill, as the page heads them; default all")
        ->delimiter(',')
        ->type_name("NAME,...");
    command
        ->add_option(
            "--device", options->device,
            "cpu, gpu, P.D as `wavepath devices` numbers them, or part of a name; default PoCL")
        ->type_name("SELECTOR");
    command->callback([options] { run_stress(*options); });
}

}  // namespace wavepath
