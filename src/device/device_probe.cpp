#include "device/device_probe.h"

#include "device/child_process.h"
#include "device/device_json.h"
#include "device/program.h"
#include "error.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <optional>
#include <string>

namespace wavepath {

namespace {

constexpr const char* probe_argument = "--wavepath-device-probe";

// ---------------------------------------------------------------------------------------- the
// child

// Builds and runs a kernel of a few items. Returns what goes wrong, "" if nothing does.
std::string try_kernel(const cl::Device& cl_device, const DeviceInfo& info) {
    constexpr std::size_t items = 256;
    try {
        Device device{info, cl_device, cl::Context(cl_device), {}};
        device.queue = cl::CommandQueue(device.context, cl_device, CL_QUEUE_PROFILING_ENABLE);
        cl::Kernel kernel(
            build_program(
                device,
                "kernel void trial(global float* x) {\n"
                "    const size_t i = get_global_id(0);\n"
                "    x[i] = fma(x[i], 0.5f, 1.0f);\n"
                "}\n"),
            "trial");
        std::vector<float> values(items);
        for (std::size_t i = 0; i < items; ++i) values[i] = static_cast<float>(i);
        const cl::Buffer buffer(
            device.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, items * 4, values.data());
        kernel.setArg(0, buffer);
        device.queue.enqueueNDRangeKernel(
            kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(64));
        device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, items * 4, values.data());
        for (std::size_t i = 0; i < items; ++i)
            if (values[i] != static_cast<float>(i) * 0.5F + 1.0F)
                return "a test kernel computes wrong numbers";
    } catch (const cl::Error& error) {
        return fmt::format("a test kernel fails: {}, OpenCL error {}", error.what(), error.err());
    } catch (const Error& error) {
        return fmt::format("a test kernel does not build: {}", error.what());
    }
    return "";
}

void report_line(const LineWriter& report, const nlohmann::json& line) {
    // A driver's text may not be UTF-8.
    report.write(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

// Reports, as lines of JSON: how many platforms there are; platform `p` itself; its devices; and
// each device again once it has run a kernel. What is known when a driver crashes has been said by
// then.
void probe_platform(uint32_t p, const LineWriter& report) {
    const std::vector<cl::Platform> platforms = loaded_platforms();
    report_line(report, {{"platforms", platforms.size()}});
    if (p >= platforms.size()) return;
    report_line(report, {{"platform", describe_empty_platform(platforms[p], p)}});
    const std::vector<cl::Device> devices = devices_of(platforms[p]);
    std::vector<DeviceInfo> infos;
    for (uint32_t d = 0; d < devices.size(); ++d) {
        infos.push_back(describe_device(platforms[p], p, devices[d], d));
        report_line(report, {{"device", infos[d]}, {"tried", !infos[d].unusable.empty()}});
    }
    for (uint32_t d = 0; d < devices.size(); ++d) {
        if (!infos[d].unusable.empty()) continue;
        infos[d].unusable = try_kernel(devices[d], infos[d]);
        if (!infos[d].unusable.empty()) infos[d].default_pool = 0;
        report_line(report, {{"device", infos[d]}, {"tried", true}});
    }
}

// --------------------------------------------------------------------------------------- the
// parent

struct PlatformReport {
    std::optional<uint32_t> platforms;  // unknown: the child failed while the drivers were loaded
    std::vector<DeviceInfo> rows;
    std::string failure;
};

PlatformReport ask_child(uint32_t p, const std::string& icd_file, std::chrono::seconds limit) {
    const ChildOutput output = run_self({probe_argument, std::to_string(p), icd_file}, limit);
    PlatformReport report;
    report.failure = output.failure;
    std::optional<DeviceInfo> platform;
    std::vector<bool> tried;
    for (const std::string& line : output.lines) {
        const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
        if (json.is_discarded()) continue;  // cut short by the crash
        if (json.contains("platforms")) report.platforms = json.at("platforms").get<uint32_t>();
        if (json.contains("platform")) platform = json.at("platform").get<DeviceInfo>();
        if (!json.contains("device")) continue;
        const auto device = json.at("device").get<DeviceInfo>();
        report.rows.resize(std::max<std::size_t>(report.rows.size(), device.device_index + 1));
        tried.resize(report.rows.size());
        report.rows[device.device_index] = device;
        tried[device.device_index] = json.at("tried").get<bool>();
    }
    for (std::size_t d = 0; d < tried.size(); ++d) {
        if (tried[d]) continue;
        report.rows[d].unusable = fmt::format("the driver {}", report.failure);
        report.rows[d].default_pool = 0;
    }
    if (report.rows.empty() && platform) {
        if (!report.failure.empty())
            platform->unusable = fmt::format("the driver {}", report.failure);
        report.rows.push_back(*platform);
    }
    return report;
}

// The files that name the drivers, as the loaders find them.
std::vector<std::filesystem::path> icd_files() {
    const char* chosen = std::getenv("OCL_ICD_VENDORS");
    const std::filesystem::path place = chosen != nullptr ? chosen : "/etc/OpenCL/vendors";
    if (!std::filesystem::is_directory(place)) return {place};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(place))
        if (entry.path().extension() == ".icd") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

// Where loading all drivers at once fails: which of them it is, and what the others have when
// loaded alone.
std::vector<DeviceInfo> list_one_by_one(std::chrono::seconds limit) {
    const std::vector<std::filesystem::path> files = icd_files();
    std::vector<std::future<PlatformReport>> reports;
    reports.reserve(files.size());
    for (const auto& file : files)
        reports.push_back(std::async(std::launch::async, ask_child, 0, file.string(), limit));
    std::vector<DeviceInfo> rows;
    for (uint32_t i = 0; i < files.size(); ++i) {
        PlatformReport report = reports[i].get();
        if (!report.platforms) {
            DeviceInfo row;
            row.platform = files[i].filename().string();
            row.unusable = fmt::format("the driver {} as it is loaded", report.failure);
            report.rows = {row};
        }
        for (DeviceInfo& row : report.rows) {
            row.platform_index = i;
            if (row.unusable.empty())
                row.unusable = fmt::format(
                    "another driver fails as it is loaded; set OCL_ICD_VENDORS={}",
                    files[i].string());
            rows.push_back(row);
        }
    }
    return rows;
}

}  // namespace

std::vector<DeviceInfo> list_devices(std::chrono::seconds limit) {
    const PlatformReport first = ask_child(0, "", limit);
    if (!first.platforms) return list_one_by_one(limit);
    std::vector<std::future<PlatformReport>> others;
    for (uint32_t p = 1; p < *first.platforms; ++p)
        others.push_back(std::async(std::launch::async, ask_child, p, "", limit));
    std::vector<DeviceInfo> rows = first.rows;
    for (auto& other : others) {
        const std::vector<DeviceInfo> more = other.get().rows;
        rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
}

bool run_device_probe(int argc, char** argv) {
    if (argc != 4 || std::string(argv[1]) != probe_argument) return false;
    if (argv[3][0] != '\0') load_only_driver(argv[3]);
    probe_platform(static_cast<uint32_t>(std::atoi(argv[2])), LineWriter());
    std::_Exit(0);  // without the drivers' exit handlers, which can crash as well
}

}  // namespace wavepath
