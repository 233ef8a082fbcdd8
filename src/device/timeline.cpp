#include "device/timeline.h"

namespace wavepath {

Timeline::Timeline(const Device& device) {
    cl::Event marker;
    const int64_t before = now();
    device.queue.enqueueMarkerWithWaitList(nullptr, &marker);
    const int64_t after = now();
    marker.wait();
    const auto queued =
        static_cast<int64_t>(marker.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>());
    offset_ = before + (after - before) / 2 - queued;
}

int64_t Timeline::now() const {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now() - begin_)
        .count();
}

void Timeline::add_launch(std::size_t row, uint64_t items, uint64_t start, uint64_t end) {
    launches_.push_back(
        {row, items, static_cast<int64_t>(start) + offset_, static_cast<int64_t>(end) + offset_});
}

void Timeline::add_span(const std::string& name, int64_t start, int64_t end) {
    spans_.push_back({name, start, end});
}

void Timeline::add_count(uint64_t slots, uint64_t rays) {
    counts_.push_back({now(), slots, rays});
}

}  // namespace wavepath
