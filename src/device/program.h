// From kernel files to a built program.
#pragma once

#include "device/device.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

// The text of one kernel file, e.g. "stages/intersect.cl": embedded in the program, or read from
// the folder that WAVEPATH_KERNELS names. Throws Error if there is no such file.
std::string kernel_file(const std::string& name);

// One OpenCL C source string: `defines` first (a line "#define NAME VALUE" each), then the files
// with every #include "x" of ours replaced, once each, by the file's text; #line keeps file names
// and line numbers.
std::string assemble_source(const std::string& defines, const std::vector<std::string>& files);

// What the driver says of a kernel that it has built.
struct KernelBuild {
    std::string name;
    uint64_t private_bytes = 0;       // an item
    uint64_t local_bytes = 0;         // a work-group
    uint64_t preferred_multiple = 0;  // of work-group sizes [items]
};

struct BuildReport {
    double seconds = 0;
    bool from_cache = false;  // our own binary cache (off PoCL); PoCL keeps its own
    std::string log;
    std::optional<uint64_t> binary_bytes;  // none: not known
    std::vector<KernelBuild> kernels;      // by name
};

// Builds with -cl-std=CL1.2 and correctly rounded division where the device has it. Off PoCL the
// binary is kept under $XDG_CACHE_HOME/wavepath, keyed by device, driver, options and source,
// written to a temporary name and renamed. Throws Error with the compiler's log, which names the
// real .cl file and line.
cl::Program build_program(
    const Device& device, const std::string& source, BuildReport* report = nullptr);

// Fills in `binary_bytes` and `kernels`, after the first launches: PoCL compiles at those. PoCL's
// binary stays unknown, because it takes seconds to hand one out.
void describe_build(const Device& device, const cl::Program& program, BuildReport& report);

}  // namespace wavepath
