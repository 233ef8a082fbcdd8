// Which OpenCL devices there are, and which one we use.
#pragma once

#include "device/opencl.h"

#include <cstdint>
#include <string>
#include <vector>

namespace wavepath {

struct DeviceInfo {
    uint32_t platform_index = 0;
    uint32_t device_index = 0;
    std::string platform, name, vendor, version, driver;
    bool is_cpu = false, is_gpu = false;
    uint32_t compute_units = 0;
    uint64_t global_memory = 0;   // [bytes]
    uint64_t max_allocation = 0;  // [bytes]
    uint64_t max_work_group = 0;
    bool correctly_rounded = false;  // -cl-fp32-correctly-rounded-divide-sqrt is honoured
    std::string unusable;            // why wavepath cannot use it; empty: it can
    uint32_t default_pool = 0;       // path slots wavepath uses there by default
};

// An open device with its context and an in-order, profiling queue.
// NOLINTNEXTLINE(bugprone-exception-escape): a move of cl2.hpp's handles, which is noexcept, throws
struct Device {
    DeviceInfo info;
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;
};

// Selector: "" (PoCL's CPU if there is one, else the first usable device), "cpu", "gpu", "P.D"
// (platform and device index as `wavepath devices` prints them), "pocl", or a part of a platform's
// or device's name, any case. Throws Error when nothing fits, listing what there is. "" lets the
// OpenCL loader load nothing but PoCL where that is installed and OCL_ICD_VENDORS is unset: a
// process that opens other devices as well opens those first.
Device open_device(const std::string& selector);

// Before the first OpenCL call of the process: makes the loader load the driver that an .icd file
// names and no other. ocl-icd takes the file itself from OCL_ICD_VENDORS; the Khronos loader wants
// a folder there, finds none, and takes the library from OCL_ICD_FILENAMES. False where the file
// cannot be read.
bool load_only_driver(const std::string& icd_file);

// The platforms the loader finds, and a platform's devices; empty, not an error, where there is
// none.
std::vector<cl::Platform> loaded_platforms();
std::vector<cl::Device> devices_of(const cl::Platform& platform);

// What the driver says of a device, and what wavepath makes of it; a driver's error is a reason not
// to use it.
DeviceInfo describe_device(
    const cl::Platform& platform,
    uint32_t platform_index,
    const cl::Device& device,
    uint32_t device_index);

// The row of a platform without devices: no device name, and `unusable`.
DeviceInfo describe_empty_platform(const cl::Platform& platform, uint32_t platform_index);

// Before the first OpenCL call of the process: PoCL gets no more threads than there are CPUs, and
// POCL_AFFINITY=1 where that is unset and CPUs 0..n-1 are the process' (docs/devices.md says why).
void prepare_environment();

}  // namespace wavepath
