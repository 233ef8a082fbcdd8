// In which windows a picture is rendered, and when it is done.
#pragma once

#include "film/film.h"
#include "wavefront/queue_manager.h"
#include "wavefront/sample_plan.h"

#include <cstdint>
#include <vector>

namespace wavepath {

// Windows are cut to about a second, so that progress, Ctrl-C and limits are met in time; the
// picture does not depend on it.
class Schedule {
  public:
    // Of `samples` a pixel, 0: until stopped; `seconds`: the time there is, 0: any. `pool`: path
    // slots, `max_cells`: the most units of work of one window.
    Schedule(uint64_t pixels, uint64_t samples, double seconds, uint32_t pool, uint64_t max_cells)
        : pixels_(pixels),
          plan_(samples, pixels),
          least_passes_(samples > 0 ? (refills * pool + pixels - 1) / pixels : 1),
          max_cells_(max_cells),
          seconds_(seconds) {}

    const SamplePlan& plan() const { return plan_; }

    // The next passes, to be rendered window by window. `elapsed`: seconds of rendering so far.
    std::vector<Window> next(const std::vector<FilmBand>& bands, double elapsed);

    // The passes that `next` gave took so long.
    void took(double seconds) {
        if (seconds > 0) rate_ = static_cast<double>(passes_) / seconds;
    }

  private:
    // Units a slot at the least, for the pool runs empty at the end of a window; an open-ended
    // render of a small picture would overshoot with them.
    static constexpr uint64_t refills = 4;

    uint64_t pixels_;
    SamplePlan plan_;
    uint64_t least_passes_;
    uint64_t max_cells_;
    double seconds_;
    double rate_ = 0;  // passes/s
    uint64_t passes_ = 0;
};

}  // namespace wavepath
