// A kernel with the types of its parameters, which times every launch.
#pragma once

#include "device/device_array.h"
#include "measure/profile.h"

#include <string>

namespace wavepath {

template <typename T>
const T& kernel_argument(const T& value) {
    return value;
}

template <typename T>
const cl::Buffer& kernel_argument(const DeviceArray<T>& array) {
    return array.buffer();
}

// Args: the parameters in order, buffers as DeviceArray<T>. Swapping two of different type does not
// compile.
template <typename... Args>
class Stage {
  public:
    // Throws cl::Error unless the program holds a kernel of this name and number of parameters.
    Stage(
        const cl::Program& program, const std::string& name, uint32_t local_size, Profile& profile)
        : kernel_(program, name.c_str()),
          local_size_(local_size),
          profile_(profile),
          row_(profile.row(name)) {
        if (kernel_.getInfo<CL_KERNEL_NUM_ARGS>() != sizeof...(Args))
            throw Error(
                "kernel {}: {} parameters, the program passes {}", name,
                kernel_.getInfo<CL_KERNEL_NUM_ARGS>(), sizeof...(Args));
    }

    // One work-item for each of `items`, rounded up to whole work-groups; nothing for none.
    void launch(const Device& device, uint64_t items, const Args&... args) {
        if (items == 0) return;
        cl_uint index = 0;
        (kernel_.setArg(index++, kernel_argument(args)), ...);
        const uint64_t groups = (items + local_size_ - 1) / local_size_;
        cl::Event event;
        device.queue.enqueueNDRangeKernel(
            kernel_, cl::NullRange, cl::NDRange(groups * local_size_), cl::NDRange(local_size_),
            nullptr, &event);
        profile_.add(row_, items, event);
    }

  private:
    cl::Kernel kernel_;
    uint32_t local_size_;
    Profile& profile_;
    std::size_t row_;
};

}  // namespace wavepath
