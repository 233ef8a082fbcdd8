#include "device/selection.h"

#include "error.h"

#include <algorithm>
#include <cctype>

namespace wavepath {

namespace {

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return text;
}

// `selector` in lower case.
bool fits(const DeviceInfo& device, const std::string& selector) {
    if (selector.empty()) return true;
    if (selector == "cpu") return device.is_cpu;
    if (selector == "gpu") return device.is_gpu;
    if (selector == "pocl") return is_pocl(device);  // whose platform has its name in full
    // An index that is not there must not be taken for a part of a name, such as "3.1".
    if (selector.find_first_not_of("0123456789.") == std::string::npos)
        return selector == fmt::format("{}.{}", device.platform_index, device.device_index);
    return lower_case(device.platform).find(selector) != std::string::npos ||
           lower_case(device.name).find(selector) != std::string::npos;
}

std::string listing(const std::vector<DeviceInfo>& devices) {
    std::string text;
    for (const DeviceInfo& device : devices) {
        text += (text.empty() ? " " : "; ") + device_label(device);
        if (!device.unusable.empty()) text += " (not usable: " + device.unusable + ")";
    }
    return text;
}

}  // namespace

bool is_pocl(const DeviceInfo& device) {
    return device.platform == "Portable Computing Language";
}

std::string device_label(const DeviceInfo& device) {
    if (device.name.empty()) return fmt::format("{} {}", device.platform_index, device.platform);
    return fmt::format(
        "{}.{} {}, {}", device.platform_index, device.device_index, device.platform, device.name);
}

std::size_t select_device(const std::vector<DeviceInfo>& devices, const std::string& selector) {
    if (devices.empty())
        throw Error(
            "no OpenCL device; install a driver, PoCL for the CPU (Debian, Ubuntu: "
            "pocl-opencl-icd), and see `wavepath devices`; one that is installed may lack memory "
            "(ulimit -v)");
    const std::string wanted = lower_case(selector);
    const auto usable = [&](const DeviceInfo& device) {
        return device.unusable.empty() && fits(device, wanted);
    };
    auto chosen = devices.end();
    if (wanted.empty())
        chosen = std::find_if(devices.begin(), devices.end(), [&](const DeviceInfo& device) {
            return usable(device) && device.is_cpu && is_pocl(device);
        });
    if (chosen == devices.end()) chosen = std::find_if(devices.begin(), devices.end(), usable);
    if (chosen != devices.end()) return static_cast<std::size_t>(chosen - devices.begin());

    const auto unusable = std::find_if(
        devices.begin(), devices.end(),
        [&](const DeviceInfo& device) { return fits(device, wanted); });
    if (unusable == devices.end())
        throw Error("--device {}: no such device; there are:{}", selector, listing(devices));
    throw Error(
        "device {}: cannot be used: {}{}", device_label(*unusable), unusable->unusable,
        devices.size() > 1 ? "; name another with --device, there are:" + listing(devices) : "");
}

}  // namespace wavepath
