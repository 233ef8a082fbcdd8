// What parameters a kernel has, read from its source: programs from binaries do not tell
// (clGetKernelArgInfo).
#pragma once

#include <string>
#include <vector>

namespace wavepath {

struct KernelParameter {
    std::string name;
    std::string type;         // of an element of the buffer: "float", "DeviceLight"
    bool is_buffer = true;    // or a number, a uint
    bool is_written = false;  // a buffer without const
    std::string declaration;  // as the kernel has it
};

// In order. `source`: one text with all macros that the parameters use, as assemble_source gives
// it. Throws Error where it holds no such kernel, or a number that is no uint.
std::vector<KernelParameter> kernel_signature(const std::string& source, const std::string& kernel);

}  // namespace wavepath
