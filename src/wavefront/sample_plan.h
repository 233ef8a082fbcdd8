// Which samples each pass takes, so that the picture is the same however the passes are scheduled.
#pragma once

#include "shared/params.h"

#include <cstdint>
#include <vector>

namespace wavepath {

// The samples of a pixel are one sequence of points. They fall into batches, whose spread tells the variance of the mean, and
// a batch into passes of at most `pass_samples`: one pass gives every pixel one unit of work. Batches are blocks of one
// scrambled sequence, not sequences of their own: on the plates scene 16 sequences of 4 points have 1.65 times the variance
// of one of 64. The price is that the spread of blocks, which repel each other, overstates it (docs/accuracy.md).
class SamplePlan {
  public:
    static constexpr uint32_t pass_samples = 8;
    static constexpr uint32_t batches = 16;        // of a fixed number of samples; fewer where there are fewer
    static constexpr uint32_t open_batch = 16;     // samples of a batch where the number is open

    // `samples` a pixel, 0: open-ended.
    explicit SamplePlan(uint64_t samples);

    // The next `count` rows, or what is left.
    std::vector<PlanRow> take(uint64_t count);
    bool done() const { return samples_ > 0 && batch_ >= batch_count_; }
    uint64_t samples_taken() const { return taken_; }      // a pixel
    uint32_t batches_closed() const { return batch_; }

  private:
    uint32_t batch_size() const;

    uint64_t samples_;
    uint32_t batch_count_;
    uint32_t batch_ = 0;
    uint32_t in_batch_ = 0;    // samples taken of the batch
    uint32_t before_ = 0;      // samples of the batches before
    uint64_t taken_ = 0;
};

}  // namespace wavepath
