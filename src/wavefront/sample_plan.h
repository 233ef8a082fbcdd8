// Which samples each pass takes, so that the picture is the same however the passes are scheduled.
#pragma once

#include "shared/params.h"

#include <cstdint>
#include <vector>

namespace wavepath {

// The samples of a pixel are one sequence of points. It is cut into batches, whose spread bounds
// the variance of the mean from above (stretches of one sequence repel each other:
// docs/accuracy.md); a batch falls into passes of at most `pass_samples`: one pass gives every
// pixel one unit of work.
class SamplePlan {
  public:
    static constexpr uint32_t pass_samples = 8;
    static constexpr uint32_t most_rows = 1U << 16U;  // of one window
    static constexpr uint32_t most_batches = 16;      // of a fixed number of samples
    static constexpr uint32_t least_batch = 16;       // samples of a batch
    static constexpr uint32_t least_batches = 4;      // even so, unless there are fewer samples

    // `samples` a pixel, 0: open-ended.
    explicit SamplePlan(uint64_t samples);

    // The next `count` rows, or what is left.
    std::vector<PlanRow> take(uint64_t count);
    // An upper bound on the rows of one window, which takes `most_rows` at the most.
    uint64_t most_passes() const;
    bool done() const { return samples_ > 0 && batch_ >= batch_count_; }
    uint64_t samples_taken() const { return taken_; }  // a pixel
    uint32_t batches_closed() const { return batch_; }

  private:
    uint32_t batch_size() const;

    uint64_t samples_;
    uint32_t batch_count_;
    uint32_t batch_ = 0;
    uint32_t in_batch_ = 0;  // samples taken of the batch
    uint32_t before_ = 0;    // samples of the batches before
    uint64_t taken_ = 0;
};

}  // namespace wavepath
