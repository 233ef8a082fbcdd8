#include "wavefront/kernel_buffers.h"

namespace wavepath {

std::size_t KernelBuffers::bytes() const {
    std::size_t sum = 0;
    for (const auto& [name, entry] : entries_) sum += entry.bytes;
    return sum;
}

const cl::Buffer& KernelBuffers::of(
    const std::string& kernel, const KernelParameter& parameter) const {
    const auto found = entries_.find(parameter.name);
    if (found == entries_.end())
        throw Error("kernel {}: parameter {}: no buffer of this name", kernel, parameter.name);
    const Entry& entry = found->second;
    if (entry.type != parameter.type)
        throw Error(
            "kernel {}: parameter {} is of {}, its buffer of {}", kernel, parameter.name,
            parameter.type, entry.type);
    if (parameter.is_written && entry.access == Access::read)
        throw Error(
            "kernel {}: parameter {} has to be const: kernels only read it", kernel,
            parameter.name);
    return entry.buffer;
}

}  // namespace wavepath
