#include "device/huge_pages.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace wavepath {

#ifdef __linux__

void prefer_huge_pages(const Device& device, const cl::Buffer& buffer, std::size_t bytes) {
    constexpr std::size_t huge_page = std::size_t{2} << 20U;
    if (!device.info.is_cpu || bytes < 2 * huge_page) return;
    void* memory =
        device.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, bytes);
    // madvise wants whole pages: those that lie within the buffer. Its refusal costs speed only.
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(memory) % page) % page;
    madvise(static_cast<char*>(memory) + before, (bytes - before) / page * page, MADV_HUGEPAGE);
    device.queue.enqueueUnmapMemObject(buffer, memory);
}

#else

void prefer_huge_pages(const Device&, const cl::Buffer&, std::size_t) {}

#endif

}  // namespace wavepath
