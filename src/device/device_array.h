// A typed buffer on the device.
#pragma once

#include "device/device.h"
#include "device/huge_pages.h"
#include "error.h"

#include <cstddef>
#include <string>
#include <vector>

namespace wavepath {

template <typename T>
// NOLINTNEXTLINE(bugprone-exception-escape): see Device
class DeviceArray {
  public:
    DeviceArray() = default;

    // An uninitialised array of `count` elements (at least one is allocated: OpenCL has no empty
    // buffers). Throws Error, naming `what`, where the device cannot hold it in one buffer.
    DeviceArray(const Device& device, std::size_t count, const std::string& what) : count_(count) {
        const std::size_t bytes = sizeof(T) * (count > 0 ? count : 1);
        if (bytes > device.info.max_allocation)
            throw Error(
                "{}: {} MiB needed in one buffer, the device allows {} MiB; use less of it (--size "
                "for the film, --pool for paths, a smaller scene), or another --device",
                what, (bytes + (std::size_t{1} << 20U) - 1) >> 20U,
                device.info.max_allocation >> 20U);
        buffer_ = cl::Buffer(device.context, CL_MEM_READ_WRITE, bytes);
        prefer_huge_pages(device, buffer_, bytes);
    }

    DeviceArray(const Device& device, const std::vector<T>& values, const std::string& what)
        : DeviceArray(device, values.size(), what) {
        if (!values.empty())
            device.queue.enqueueWriteBuffer(
                buffer_, CL_TRUE, 0, sizeof(T) * values.size(), values.data());
    }

    std::size_t size() const { return count_; }
    std::size_t bytes() const { return sizeof(T) * count_; }
    const cl::Buffer& buffer() const { return buffer_; }

    std::vector<T> read(const Device& device) const {
        std::vector<T> values(count_);
        if (count_ > 0) device.queue.enqueueReadBuffer(buffer_, CL_TRUE, 0, bytes(), values.data());
        return values;
    }

  private:
    cl::Buffer buffer_;
    std::size_t count_ = 0;
};

}  // namespace wavepath
