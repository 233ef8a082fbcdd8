// A kernel with its buffers, which times every launch.
#pragma once

#include "device/profile.h"
#include "wavefront/kernel_buffers.h"

#include <initializer_list>
#include <string>
#include <vector>

namespace wavepath {

// The work-items of a launch.
struct LaunchSize {
    uint32_t local_size;
    uint32_t slots_per_item = 1;
};

class Stage {
  public:
    // Sets every parameter that is a buffer, once. Throws Error where `buffers` lacks one,
    // cl::Error where the program lacks the kernel. `source`: of the program.
    Stage(
        const cl::Program& program,
        const std::string& source,
        const std::string& name,
        const KernelBuffers& buffers,
        LaunchSize size,
        Profile& profile);

    // Takes those of its parameters that `buffers` has from there, from the next launch on.
    void rebind(const KernelBuffers& buffers);

    // `numbers`: the parameters that are no buffers, in order. Rounded up to whole work-groups;
    // nothing for no slots. Throws Error for more or fewer numbers than the kernel takes.
    void launch(const Device& device, uint64_t slots, std::initializer_list<cl_uint> numbers);

  private:
    std::vector<KernelParameter> parameters_;
    std::vector<cl_uint> numbers_;  // which parameters are numbers
    std::string name_;
    cl::Kernel kernel_;
    LaunchSize size_;
    Profile& profile_;
    std::size_t row_;
};

}  // namespace wavepath
