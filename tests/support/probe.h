// Runs device functions of kernels/ by themselves: a program of kernel files and a few kernels of
// the test's own.
#pragma once

#include "device/device.h"
#include "device/device_array.h"

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace wavepath {

// The device that WAVEPATH_TEST_DEVICE selects (see open_device), opened once.
const Device& test_device();

// WAVEPATH_TEST_SCALE, a fraction of all sample counts (1 by default): for interpreters such as
// oclgrind.
double test_scale();

// `samples` times test_scale(), at least 1.
std::size_t scaled(std::size_t samples);

class Probe {
  public:
    // `text` holds kernels of the form
    //   kernel void name(const uint count, global T* out, ...) { guard by count }
    // and may use everything that `files` (paths below kernels/) declare.
    // `defines`: lines for kernels/shared/features.h.
    Probe(
        const std::vector<std::string>& files,
        const std::string& text,
        const std::string& defines = "");

    // Runs `kernel` for `items` work-items on `results` zeros and returns them; a std::vector among
    // `arguments` becomes a buffer, anything else is passed as it is.
    template <typename T, typename... Arguments>
    std::vector<T> run(
        const std::string& kernel,
        std::size_t items,
        std::size_t results,
        const Arguments&... arguments) const {
        const Device& device = test_device();
        const DeviceArray<T> out(device, std::vector<T>(results), "results of the probe");
        cl::Kernel launched(program_, kernel.c_str());
        std::vector<cl::Buffer> buffers;  // alive until the kernel has run
        cl_uint index = 0;
        launched.setArg(index++, static_cast<cl_uint>(items));
        launched.setArg(index++, out.buffer());
        (bind(launched, index++, arguments, buffers), ...);
        launch(launched, items);
        return out.read(device);
    }

  private:
    template <typename T>
    static void bind(
        cl::Kernel& kernel,
        cl_uint index,
        const T& argument,
        std::vector<cl::Buffer>& /*buffers*/) {
        static_assert(std::is_arithmetic_v<T>);
        kernel.setArg(index, argument);
    }

    template <typename T>
    static void bind(
        cl::Kernel& kernel,
        cl_uint index,
        const std::vector<T>& argument,
        std::vector<cl::Buffer>& buffers) {
        const DeviceArray<T> array(test_device(), argument, "argument of the probe");
        buffers.push_back(array.buffer());
        kernel.setArg(index, array.buffer());
    }

    static void launch(const cl::Kernel& kernel, std::size_t items);

    cl::Program program_;
};

}  // namespace wavepath
