// What happened when, on one clock: launches on the device, work of the host, counts of paths.
#pragma once

#include "device/device.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace wavepath {

// Grows with every launch, some 40 bytes each. Times are nanoseconds since it was made, by the
// host's steady clock.
class Timeline {
  public:
    struct Launch {
        std::size_t row;  // of Profile::rows
        uint64_t items;
        int64_t start, end;
    };
    struct Span {
        std::string name;
        int64_t start, end;
    };
    struct Count {
        int64_t time;    // when the host knew
        uint64_t slots;  // with work
        uint64_t rays;   // that they are about to trace
    };

    // Finds the offset between the two clocks: a marker is queued, and the device's time of that is
    // taken for the middle of the call. Half the call's length is therefore the offset's error,
    // some microseconds; that the clocks may drift apart later is not followed.
    explicit Timeline(const Device& device);

    int64_t now() const;
    // `start`, `end`: by the device's clock [ns].
    void add_launch(std::size_t row, uint64_t items, uint64_t start, uint64_t end);
    void add_span(const std::string& name, int64_t start, int64_t end);
    void add_count(uint64_t slots, uint64_t rays);

    const std::vector<Launch>& launches() const { return launches_; }
    const std::vector<Span>& spans() const { return spans_; }  // of the host, as they ended
    const std::vector<Count>& counts() const { return counts_; }

  private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    int64_t offset_ = 0;  // from the device's clock to ours [ns]
    std::vector<Launch> launches_;
    std::vector<Span> spans_;
    std::vector<Count> counts_;
};

// A span of the host, from here to the end of the scope. `timeline` may be 0.
class HostSpan {
  public:
    HostSpan(Timeline* timeline, const char* name)
        : timeline_(timeline), name_(name), start_(timeline != nullptr ? timeline->now() : 0) {}
    HostSpan(const HostSpan&) = delete;
    HostSpan& operator=(const HostSpan&) = delete;
    ~HostSpan() {
        if (timeline_ != nullptr) timeline_->add_span(name_, start_, timeline_->now());
    }

  private:
    Timeline* timeline_;
    const char* name_;
    int64_t start_;
};

}  // namespace wavepath
