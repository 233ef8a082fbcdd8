// `wavepath profile --against`: the same estimator by other kernels or on another device.
#pragma once

#include "commands/render_options.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

// What a render is compared with.
// NOLINTNEXTLINE(bugprone-exception-escape): see Device
struct Baseline {
    std::string name;  // as --against has it
    Kernels kernels = Kernels::specialised;
    std::optional<Device> device;  // another one
};

void add_baseline_options(CLI::App& app, std::vector<std::string>& names);

// Opens the devices that are named, so it has to come before the render's own is opened
// (open_device). Throws Error where there is no such device, and for a number of samples that is
// not fixed.
std::vector<Baseline> open_baselines(
    const std::vector<std::string>& names, const RenderOptions& options);

// Renders in turns with the baselines and prints a table to standard output. Returns the key
// "baselines" of the report (docs/report.md). A signal to stop ends it after the last whole round.
// `result`: of the job on the device, with whose picture all others are compared.
nlohmann::ordered_json compare_with(
    const std::vector<Baseline>& baselines,
    const Device& device,
    const RenderJob& job,
    const RenderResult& result);

}  // namespace wavepath
