#include "commands/devices.h"

#include "commands/json_text.h"
#include "device/device_json.h"
#include "device/device_probe.h"
#include "device/selection.h"
#include "error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace wavepath {

namespace {

constexpr int schema_version = 1;  // of --json, docs/devices.md

// "1.5 GiB", in the largest unit that leaves a whole part.
std::string human_bytes(uint64_t bytes) {
    if (bytes >> 30U == 0) return fmt::format("{} MiB", bytes >> 20U);
    return fmt::format("{:.1f} GiB", static_cast<double>(bytes) / double{1U << 30U});
}

// Which row the default selector means; none where no row is usable.
std::size_t default_row(const std::vector<DeviceInfo>& devices) {
    try {
        return select_device(devices, "");
    } catch (const Error&) {
        return devices.size();
    }
}

void print_table(const std::vector<DeviceInfo>& devices) {
    if (devices.empty()) {
        fmt::print(
            "No OpenCL driver is installed: install one, PoCL for the CPU (Debian, Ubuntu: "
            "pocl-opencl-icd).\n");
        return;
    }
    const std::size_t chosen = default_row(devices);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        fmt::print("{}{}\n", device_label(device), i == chosen ? "  (default)" : "");
        if (!device.version.empty()) fmt::print("    version   {}\n", device.version);
        if (!device.name.empty()) {
            fmt::print("    driver    {} ({})\n", device.driver, device.vendor);
            fmt::print(
                "    type      {}, {} compute units\n",
                device.is_cpu   ? "CPU"
                : device.is_gpu ? "GPU"
                                : "accelerator",
                device.compute_units);
            fmt::print(
                "    memory    {}, up to {} in one buffer\n", human_bytes(device.global_memory),
                human_bytes(device.max_allocation));
            fmt::print(
                "    limits    work-groups of up to {}; division and square root {}\n",
                device.max_work_group,
                device.correctly_rounded ? "correctly rounded"
                                         : "not guaranteed to be correctly rounded");
        }
        if (device.unusable.empty())
            fmt::print(
                "    usable    with {} paths at once by default (--pool)\n", device.default_pool);
        else
            fmt::print("    unusable  {}\n", device.unusable);
    }
}

void print_json(const std::vector<DeviceInfo>& devices) {
    const std::size_t chosen = default_row(devices);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        nlohmann::ordered_json row = nlohmann::json(devices[i]);
        row["usable"] = devices[i].unusable.empty();
        row["default"] = i == chosen;
        rows.push_back(row);
    }
    const nlohmann::ordered_json report = {
        {"schema", "wavepath devices"}, {"schema_version", schema_version}, {"devices", rows}};
    fmt::print("{}\n", json_text(report, 2));
}

}  // namespace

void add_devices_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "devices", "List every OpenCL platform and device, and whether wavepath can use it");
    const auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "Print JSON, as docs/devices.md describes it");
    command->callback([as_json] {
        const std::vector<DeviceInfo> devices = list_devices();
        if (*as_json)
            print_json(devices);
        else
            print_table(devices);
    });
}

}  // namespace wavepath
