// A kernel with the types of its parameters, which times every launch.
#pragma once

#include "device/device_array.h"
#include "device/profile.h"
#include "device/scene_buffers.h"

#include <string>

namespace wavepath {

// How many of a kernel's parameters a value is, and how they are set, from `index` on.
template <typename T>
struct KernelArgument {
    static constexpr cl_uint count = 1;
    static void set(cl::Kernel& kernel, cl_uint index, const T& value) {
        kernel.setArg(index, value);
    }
};

template <typename T>
struct KernelArgument<DeviceArray<T>> {
    static constexpr cl_uint count = 1;
    static void set(cl::Kernel& kernel, cl_uint index, const DeviceArray<T>& array) {
        kernel.setArg(index, array.buffer());
    }
};

// TEXTURE_PARAMETERS of materials/texture.cl
template <>
struct KernelArgument<DeviceTextures> {
    static constexpr cl_uint count = 1 + TEXTURE_MOST_PAGES;
    static void set(cl::Kernel& kernel, cl_uint index, const DeviceTextures& textures) {
        kernel.setArg(index++, textures.rows.buffer());
        for (const auto& page : textures.pages) kernel.setArg(index++, page.buffer());
    }
};

// Args: the parameters in order, buffers as DeviceArray<T>. Swapping two of different type does not
// compile.
template <typename... Args>
class Stage {
  public:
    // A work-item does `slots_per_item` slots. Throws cl::Error unless the program holds a kernel
    // of this name and number of parameters.
    Stage(
        const cl::Program& program,
        const std::string& name,
        uint32_t local_size,
        Profile& profile,
        uint32_t slots_per_item = 1)
        : kernel_(program, name.c_str()),
          local_size_(local_size),
          slots_per_group_(uint64_t{local_size} * slots_per_item),
          profile_(profile),
          row_(profile.row(name)) {
        constexpr cl_uint passed = (KernelArgument<Args>::count + ...);
        if (kernel_.getInfo<CL_KERNEL_NUM_ARGS>() != passed)
            throw Error(
                "kernel {}: {} parameters, the program passes {}", name,
                kernel_.getInfo<CL_KERNEL_NUM_ARGS>(), passed);
    }

    // Rounded up to whole work-groups; nothing for no slots.
    void launch(const Device& device, uint64_t slots, const Args&... args) {
        if (slots == 0) return;
        cl_uint index = 0;
        ((KernelArgument<Args>::set(kernel_, index, args), index += KernelArgument<Args>::count),
         ...);
        const uint64_t groups = (slots + slots_per_group_ - 1) / slots_per_group_;
        cl::Event event;
        device.queue.enqueueNDRangeKernel(
            kernel_, cl::NullRange, cl::NDRange(groups * local_size_), cl::NDRange(local_size_),
            nullptr, &event);
        profile_.add(row_, slots, event);
    }

  private:
    cl::Kernel kernel_;
    uint32_t local_size_;
    uint64_t slots_per_group_;
    Profile& profile_;
    std::size_t row_;
};

}  // namespace wavepath
