// A typed buffer on the device.
#pragma once

#include "device/device.h"
#include "device/huge_pages.h"
#include "error.h"

#include <cstddef>
#include <string>
#include <vector>

namespace wavepath {

// What an array holds, for the host to read while this lives. Of a CPU device it is the buffer
// itself and no copy.
template <typename T>
class MappedArray {
  public:
    MappedArray(const cl::CommandQueue& queue, const cl::Buffer& buffer, std::size_t bytes)
        : queue_(queue),
          buffer_(buffer),
          values_(static_cast<const T*>(
              queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, bytes))) {}
    MappedArray(const MappedArray&) = delete;
    MappedArray& operator=(const MappedArray&) = delete;
    // Waits, for a buffer whose unmapping is under way is not given back.
    ~MappedArray() {
        try {
            queue_.enqueueUnmapMemObject(buffer_, const_cast<T*>(values_));
            queue_.finish();
        } catch (const cl::Error&) {
            // A device that is lost: the next command says so.
        }
    }

    const T& operator[](std::size_t i) const { return values_[i]; }

  private:
    const cl::CommandQueue& queue_;
    cl::Buffer buffer_;
    const T* values_;
};

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
                "{}: {} MiB needed in one buffer, the device allows {} MiB; use less of it (--pool "
                "for paths, a smaller scene), or another --device",
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

    MappedArray<T> map(const Device& device) const { return {device.queue, buffer_, bytes()}; }

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
