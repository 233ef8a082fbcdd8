#include "device/device.h"

#include "device/selection.h"
#include "error.h"

#include <sched.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace wavepath {

namespace {

constexpr uint64_t minimum_memory =
    256ULL << 20U;  // [bytes] the smallest pool with a scene of a few thousand triangles

// PoCL builds a kernel once more for grids of 65535 work-items and up: a pool below that size needs
// one build a kernel.
constexpr uint32_t cpu_pool = 65280;
constexpr uint32_t gpu_pool = 1U << 20U;
constexpr uint64_t slot_bytes = 512;  // more than any feature set's planes and queues take per slot

std::string trimmed(const std::string& text) {
    const auto blank = [](unsigned char c) { return std::isspace(c) != 0 || c == 0; };
    const auto first = std::find_if_not(text.begin(), text.end(), blank);
    const auto last =
        std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), blank).base();
    return {first, last};
}

// "OpenCL 1.2 CUDA" -> 12; 0 where a driver breaks the rule for this string.
int opencl_version(const std::string& version) {
    int major = 0, minor = 0;
    if (std::sscanf(version.c_str(), "OpenCL %d.%d", &major, &minor) != 2) return 0;
    return 10 * major + minor;
}

void query(const cl::Device& device, DeviceInfo& info) {
    const auto type = device.getInfo<CL_DEVICE_TYPE>();
    const auto float_config = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
    info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
    info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
    info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
    info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
    info.is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    info.is_gpu = (type & CL_DEVICE_TYPE_GPU) != 0;
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.global_memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.max_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.max_work_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    info.correctly_rounded = (float_config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
}

std::string why_unusable(const cl::Device& device, const DeviceInfo& info) {
    const auto float_config = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
    if (device.getInfo<CL_DEVICE_AVAILABLE>() == CL_FALSE)
        return "the driver says it is not available";
    if (opencl_version(info.version) < 12)
        return fmt::format("OpenCL 1.2 is needed, it has \"{}\"", info.version);
    if (device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() == CL_FALSE)
        return "its driver has no compiler";
    if (device.getInfo<CL_DEVICE_ENDIAN_LITTLE>() == CL_FALSE) return "it is big endian";
    if ((float_config & CL_FP_INF_NAN) == 0 || (float_config & CL_FP_ROUND_TO_NEAREST) == 0)
        return "its floats have no infinities or do not round to nearest";
    if (info.max_work_group < 256)
        return fmt::format("work-groups of 256 are needed, it allows {}", info.max_work_group);
    if (info.global_memory < minimum_memory)
        return fmt::format(
            "{} MiB of memory are needed, it has {}", minimum_memory >> 20U,
            info.global_memory >> 20U);
    return "";
}

uint32_t pool_for(const DeviceInfo& info) {
    if (info.is_cpu) return cpu_pool;
    const uint64_t fitting =
        info.global_memory / 4 / slot_bytes;  // leaves three quarters to the scene and the film
    return static_cast<uint32_t>(std::min<uint64_t>(gpu_pool, fitting / 256 * 256));
}

constexpr const char* pocl_icd = "/etc/OpenCL/vendors/pocl.icd";

bool user_chose_drivers() {
    for (const char* choice : {"OCL_ICD_VENDORS", "OCL_ICD_FILENAMES", "OPENCL_VENDOR_PATH"})
        if (std::getenv(choice) != nullptr) return true;
    return false;
}

// PoCL starts as many threads as it is told, crashes where that is below 0, and by POCL_AFFINITY
// aborts where one has no CPU. The names are those of PoCL up to 3, from 4 and from 7 on.
void limit_pocl_threads(long cpus) {
    for (const char* variable :
         {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT", "POCL_MAX_COMPUTE_UNITS"}) {
        const char* value = std::getenv(variable);
        if (value == nullptr) continue;
        const long threads = std::strtol(value, nullptr, 10);
        if (threads >= 0 && threads <= cpus) continue;
        spdlog::warn("{}={}: there are {} CPUs; it is taken as {}", variable, value, cpus, cpus);
        setenv(variable, std::to_string(cpus).c_str(), 1);
    }
}

// Below it drivers abort as they start their threads.
void check_address_space() {
    constexpr rlim_t least = rlim_t{512} << 20U;  // [bytes]
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur < least)
        throw Error(
            "the limit on memory (ulimit -v) is {} MiB: OpenCL drivers need more than {} MiB to "
            "start; raise it",
            limit.rlim_cur >> 20U, least >> 20U);
}

}  // namespace

void prepare_environment() {
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    limit_pocl_threads(online);
    cpu_set_t allowed;
    if (std::getenv("POCL_AFFINITY") != nullptr ||
        sched_getaffinity(0, sizeof(allowed), &allowed) != 0)
        return;
    // PoCL pins its worker i to CPU i, and aborts or leaves the process' mask where that CPU is not
    // ours.
    for (int cpu = 0; cpu < online; ++cpu)
        if (!CPU_ISSET(cpu, &allowed)) return;
    setenv("POCL_AFFINITY", "1", 0);
}

bool load_only_driver(const std::string& icd_file) {
    std::ifstream file(icd_file);
    std::string library;
    if (!std::getline(file, library)) return false;
    setenv("OCL_ICD_VENDORS", icd_file.c_str(), 1);
    setenv("OCL_ICD_FILENAMES", library.c_str(), 1);
    return true;
}

std::vector<cl::Platform> loaded_platforms() {
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        platforms.clear();  // CL_PLATFORM_NOT_FOUND_KHR: no driver is installed
    }
    return platforms;
}

std::vector<cl::Device> devices_of(const cl::Platform& platform) {
    std::vector<cl::Device> devices;
    try {
        platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
        devices.clear();  // CL_DEVICE_NOT_FOUND: e.g. Rusticl without RUSTICL_ENABLE
    }
    return devices;
}

DeviceInfo describe_device(
    const cl::Platform& platform,
    uint32_t platform_index,
    const cl::Device& device,
    uint32_t device_index) {
    DeviceInfo info;
    info.platform_index = platform_index;
    info.device_index = device_index;
    info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    try {
        query(device, info);
        info.unusable = why_unusable(device, info);
    } catch (const cl::Error& error) {
        info.unusable =
            fmt::format("its driver fails: {}, OpenCL error {}", error.what(), error.err());
    }
    info.default_pool = info.unusable.empty() ? pool_for(info) : 0;
    return info;
}

DeviceInfo describe_empty_platform(const cl::Platform& platform, uint32_t platform_index) {
    DeviceInfo info;
    info.platform_index = platform_index;
    info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.vendor = trimmed(platform.getInfo<CL_PLATFORM_VENDOR>());
    info.version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
    info.unusable = "the platform has no device";
    if (info.platform == "rusticl")
        info.unusable += " (Rusticl has those that RUSTICL_ENABLE names)";
    if (is_pocl(info))
        info.unusable +=
            " (PoCL has none where it cannot write its cache: name a folder by POCL_CACHE_DIR; "
            "where POCL_DEVICES names none; and where memory or processes run out: see ulimit)";
    return info;
}

Device open_device(const std::string& selector) {
    check_address_space();
    // The default device is PoCL's, and the other drivers are then better not loaded: they cost
    // 12-18 ms of start-up here (docs/devices.md), and one that crashes as it is loaded would take
    // the render with it.
    const bool only_pocl = selector.empty() && !user_chose_drivers() && load_only_driver(pocl_icd);
    const std::vector<cl::Platform> platforms = loaded_platforms();
    if (only_pocl)  // the loader has read them; child processes are to have the user's choice
        for (const char* variable : {"OCL_ICD_VENDORS", "OCL_ICD_FILENAMES"}) unsetenv(variable);
    std::vector<DeviceInfo> infos;
    std::vector<cl::Device> devices;
    for (uint32_t p = 0; p < platforms.size(); ++p) {
        const std::vector<cl::Device> of_platform = devices_of(platforms[p]);
        for (uint32_t d = 0; d < of_platform.size(); ++d) {
            infos.push_back(describe_device(platforms[p], p, of_platform[d], d));
            devices.push_back(of_platform[d]);
        }
        if (of_platform.empty()) {
            infos.push_back(describe_empty_platform(platforms[p], p));
            devices.emplace_back();
        }
    }
    Device opened;
    const std::size_t chosen = select_device(infos, selector);
    opened.info = infos[chosen];
    opened.device = devices[chosen];
    try {
        opened.context = cl::Context(opened.device);
        opened.queue = cl::CommandQueue(opened.context, opened.device, CL_QUEUE_PROFILING_ENABLE);
    } catch (const cl::Error& error) {
        throw Error(
            "device {}.{} \"{}\": {} fails with OpenCL error {}; try another --device, see "
            "`wavepath devices`",
            opened.info.platform_index, opened.info.device_index, opened.info.name, error.what(),
            error.err());
    }
    return opened;
}

}  // namespace wavepath
