#include "commands/baselines.h"

#include "commands/interrupt.h"
#include "device/driver_failure.h"
#include "error.h"
#include "wavefront/upload.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

namespace wavepath {

namespace {

// Odd, so that the median is one of them. That of all rounds there could be lies between the least
// and the greatest of 5 with probability 1 - 2 / 2^5 = .94.
constexpr std::size_t rounds = 5;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// Pixels that differ in a bit of any layer.
uint64_t differing_pixels(const Image& a, const Image& b) {
    std::vector<bool> differs(std::size_t{a.width} * a.height, false);
    for (const auto& [name, plane] : a.channels) {
        const std::vector<float>& other = b.channels.at(name);
        for (std::size_t i = 0; i < plane.size(); ++i)
            if (std::memcmp(&plane[i], &other[i], sizeof(float)) != 0) differs[i] = true;
    }
    return static_cast<uint64_t>(std::ranges::count(differs, true));
}

// One side of the comparison: where it is rendered, and how.
struct Side {
    const Device& device;
    const UploadedScene& scene;
    RenderSettings settings;
    std::vector<double> seconds = {};  // of each round
    uint64_t differing = 0;
};

// Each side once, every other round in the opposite order, so that a machine that slows down
// favours none. False where a signal ended it.
bool play_round(
    std::vector<Side>& sides,
    bool backwards,
    const RenderResult& result,
    const InterruptGuard& interrupt) {
    const auto stop = [&] { return interrupt.requested(); };
    std::vector<double> seconds(sides.size());
    for (std::size_t turn = 0; turn < sides.size(); ++turn) {
        const std::size_t i = backwards ? sides.size() - 1 - turn : turn;
        Side& side = sides[i];
        const RenderResult other = render(side.device, side.scene, side.settings, {}, stop);
        if (interrupt.requested()) return false;
        seconds[i] = other.times.render;
        side.differing = differing_pixels(result.film.image, other.film.image);
    }
    for (std::size_t i = 0; i < sides.size(); ++i) sides[i].seconds.push_back(seconds[i]);
    return true;
}

// How many times as long as `profiled` a side took, round by round, in ascending order.
std::vector<double> ratios(const Side& side, const Side& profiled) {
    std::vector<double> list;
    for (std::size_t i = 0; i < side.seconds.size(); ++i)
        list.push_back(side.seconds[i] / profiled.seconds[i]);
    std::ranges::sort(list);
    return list;
}

nlohmann::ordered_json row_of(const Baseline& baseline, const Side& side, const Side& profiled) {
    const std::vector<double> ratio = ratios(side, profiled);
    return {
        {"against", baseline.name},
        {"platform", side.device.info.platform},
        {"device", side.device.info.name},
        {"rounds", ratio.size()},
        {"profiled_seconds", median(profiled.seconds)},
        {"seconds", median(side.seconds)},
        {"ratio", median(ratio)},
        {"least_ratio", ratio.front()},
        {"greatest_ratio", ratio.back()},
        {"differing_pixels", side.differing},
    };
}

std::string verdict(double least, double ratio, double greatest) {
    if (least > 1) return fmt::format("the profiled render gains: {:.2f} times as fast", ratio);
    if (greatest < 1)
        return fmt::format("the profiled render loses: {:.2f} times as slow", 1 / ratio);
    return "no difference that these rounds tell";
}

void print_rows(const nlohmann::ordered_json& rows, double pixels) {
    fmt::print(
        "\n{:<18}{:>10}{:>10}{:>18}  {:<22}{}\n", "against", "ms", "ratio", "of the rounds",
        "picture", "so");
    for (const auto& row : rows) {
        const double ratio = row["ratio"];
        const double least = row["least_ratio"];
        const double greatest = row["greatest_ratio"];
        const uint64_t differing = row["differing_pixels"];
        fmt::print(
            "{:<18}{:>10.1f}{:>10.2f}{:>18}  {:<22}{}\n", row["against"].get<std::string>(),
            1e3 * row["seconds"].get<double>(), ratio,
            fmt::format("{:.2f} to {:.2f}", least, greatest),
            differing == 0
                ? "same bits"
                : fmt::format(
                      "{:.3g} % pixels differ", 100 * static_cast<double>(differing) / pixels),
            verdict(least, ratio, greatest));
    }
    if (!rows.empty())
        fmt::print(
            "{:<18}{:>10.1f}  the profiled render; medians of {} rounds in turns\n", "itself",
            1e3 * rows[0]["profiled_seconds"].get<double>(), rows[0]["rounds"].get<std::size_t>());
}

}  // namespace

void add_baseline_options(CLI::App& app, std::vector<std::string>& names) {
    app.add_option(
           "--against", names,
           "Render by this as well, in turns, and compare; may be given again: one kernel for "
           "whole paths, kernels with features that the scene does not need, or another device")
        ->type_name("megakernel|full-features|SELECTOR")
        ->allow_extra_args(false)
        ->group("Comparison");
}

std::vector<Baseline> open_baselines(
    const std::vector<std::string>& names, const RenderOptions& options) {
    if (!names.empty() && (options.time || options.target_error))
        throw Error(
            "--against {}: compares renders of the same samples; use --spp, not --time or "
            "--target-error",
            names.front());
    prepare_signals();
    std::vector<Baseline> baselines;
    for (const std::string& name : names) {
        Baseline& baseline = baselines.emplace_back();
        baseline.name = name;
        if (name == "megakernel")
            baseline.kernels = Kernels::megakernel;
        else if (name == "full-features")
            baseline.kernels = Kernels::full_features;
        else
            baseline.device = open_device(name);
    }
    return baselines;
}

nlohmann::ordered_json compare_with(
    const std::vector<Baseline>& baselines,
    const Device& device,
    const RenderJob& job,
    const RenderResult& result) {
    spdlog::info("{} rounds against {} more", rounds, baselines.size());
    const InterruptGuard interrupt;
    const DriverFailureGuard driver;
    RenderSettings settings = job.settings;
    settings.kernels = Kernels::full_features;  // what they need does not slow the others
    const UploadedScene here = upload(device, job.scene, settings);
    std::vector<UploadedScene> elsewhere;
    elsewhere.reserve(baselines.size());
    std::vector<Side> sides{{device, here, job.settings}};
    for (const Baseline& baseline : baselines) {
        settings.kernels = baseline.kernels;
        if (baseline.device) elsewhere.push_back(upload(*baseline.device, job.scene, settings));
        sides.push_back(
            {baseline.device ? *baseline.device : device, baseline.device ? elsewhere.back() : here,
             settings});
    }
    for (std::size_t round = 0; round < rounds; ++round)
        if (!play_round(sides, round % 2 == 1, result, interrupt)) break;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    if (sides.front().seconds.empty()) return rows;
    for (std::size_t i = 0; i < baselines.size(); ++i)
        rows.push_back(row_of(baselines[i], sides[i + 1], sides.front()));
    print_rows(rows, double{1} * job.settings.width * job.settings.height);
    return rows;
}

}  // namespace wavepath
