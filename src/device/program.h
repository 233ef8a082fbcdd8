// From kernel files to a built program.
#pragma once

#include "device/device.h"

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

struct BuildReport {
    double seconds = 0;
    bool from_cache = false;  // our own binary cache (off PoCL); PoCL keeps its own
    std::string log;
};

// Builds with -cl-std=CL1.2 and correctly rounded division where the device has it. Off PoCL the
// binary is kept under $XDG_CACHE_HOME/wavepath, keyed by device, driver, options and source,
// written to a temporary name and renamed. Throws Error with the compiler's log, which names the
// real .cl file and line.
cl::Program build_program(
    const Device& device, const std::string& source, BuildReport* report = nullptr);

}  // namespace wavepath
