#include "device/profile.h"

#include <algorithm>

namespace wavepath {

std::size_t Profile::row(const std::string& name) {
    const auto found = std::ranges::find(rows_, name, &ProfileRow::name);
    if (found == rows_.end()) {
        rows_.push_back({name});
        return rows_.size() - 1;
    }
    return static_cast<std::size_t>(found - rows_.begin());
}

void Profile::add(std::size_t row, uint64_t items, const cl::Event& event) {
    ++rows_[row].launches;
    rows_[row].items += items;
    pending_.push_back({row, items, event});
    if (pending_.size() < most_pending) return;
    event.wait();
    collect();
}

void Profile::collect() {
    for (const Launch& launch : pending_) {
        const cl_ulong start = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const cl_ulong end = launch.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        if (end == 0) device_clock_ = false;  // Rusticl 22.3
        rows_[launch.row].seconds += 1e-9 * static_cast<double>(end - start);
        if (timeline_ && end != 0) timeline_->add_launch(launch.row, launch.items, start, end);
    }
    pending_.clear();
}

double Profile::kernel_seconds() const {
    double sum = 0;
    for (const ProfileRow& row : rows_) sum += row.seconds;
    return sum;
}

}  // namespace wavepath
