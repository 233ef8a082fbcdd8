// Time and items of every kernel, from OpenCL events.
#pragma once

#include "device/opencl.h"
#include "device/timeline.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

struct ProfileRow {
    std::string name;  // of the kernel
    uint64_t launches = 0;
    uint64_t items = 0;
    double seconds = 0;  // between start and end on the device
};

class Profile {
  public:
    // The row of this name, made if there is none.
    std::size_t row(const std::string& name);
    // Of a launch on a queue in order. Waits for it and collects where `most_pending` are held: an
    // event takes some 200 bytes, and a window has any number of launches.
    void add(std::size_t row, uint64_t items, const cl::Event& event);

    // Reads the times of launches that have finished; to be called after a blocking read. Where the
    // driver returns zeros, `device_clock` turns false and times stay 0.
    void collect();

    // From now on every launch is kept by itself, too.
    void keep_timeline(const Device& device) { timeline_.emplace(device); }
    Timeline* timeline() { return timeline_ ? &*timeline_ : nullptr; }  // 0: none is kept
    std::optional<Timeline> take_timeline() { return std::move(timeline_); }

    static constexpr std::size_t most_pending = 4096;
    std::size_t pending() const { return pending_.size(); }

    const std::vector<ProfileRow>& rows() const { return rows_; }
    bool device_clock() const { return device_clock_; }
    double kernel_seconds() const;

  private:
    struct Launch {
        std::size_t row;
        uint64_t items;
        cl::Event event;
    };

    std::vector<ProfileRow> rows_;
    std::vector<Launch> pending_;
    std::optional<Timeline> timeline_;
    bool device_clock_ = true;
};

}  // namespace wavepath
