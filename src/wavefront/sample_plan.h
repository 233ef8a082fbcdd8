// Which samples each pass takes, so that the picture is the same however the passes are scheduled.
#pragma once

#include "shared/params.h"

#include <cstdint>
#include <vector>

namespace wavepath {

// The samples of a pixel are one sequence of points. It is cut into batches, whose spread bounds
// the variance of the mean from above (stretches of one sequence repel each other:
// docs/measurements/2026-11-22-noise.md); a batch falls into passes: one pass gives every pixel one
// unit of work.
class SamplePlan {
  public:
    static constexpr uint32_t most_rows = 1U << 16U;  // of one window

    // `samples` a pixel, 0: open-ended. Of a large picture a pass takes fewer, so that it ends in a
    // second or two.
    SamplePlan(uint64_t samples, uint64_t pixels);

    // The next `count` rows, or what is left.
    std::vector<PlanRow> take(uint64_t count);
    // An upper bound on the rows of one window, which takes `most_rows` at the most.
    uint64_t most_passes() const;
    bool done() const { return samples_ > 0 && taken_ >= samples_; }
    uint64_t samples_taken() const { return taken_; }  // a pixel
    uint32_t batches_closed() const { return batches_; }

  private:
    // Of the batch in hand: an eighth of what came before it, for the longer the batches, the
    // closer the bound.
    uint64_t batch_size() const;

    uint64_t samples_;
    uint64_t pass_samples_;
    uint32_t batches_ = 0;
    uint64_t in_batch_ = 0;  // samples taken of the batch
    uint64_t before_ = 0;    // samples of the batches before
    uint64_t taken_ = 0;
};

}  // namespace wavepath
