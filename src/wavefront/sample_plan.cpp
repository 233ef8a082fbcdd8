#include "wavefront/sample_plan.h"

#include <algorithm>
#include <bit>

namespace wavepath {

namespace {

constexpr uint64_t first_batch = 16;  // samples; a quarter of them all if that is less
constexpr uint64_t most_pass_samples = 8;
constexpr uint64_t picture_samples = uint64_t{1} << 21U;  // of a pass, in all pixels

}  // namespace

SamplePlan::SamplePlan(uint64_t samples, uint64_t pixels)
    : samples_(samples),
      pass_samples_(std::clamp<uint64_t>(picture_samples / pixels, 1, most_pass_samples)) {}

uint64_t SamplePlan::batch_size() const {
    const uint64_t grown = std::bit_floor(before_ / 8);
    if (samples_ == 0) return std::max(first_batch, grown);
    const uint64_t first = std::clamp<uint64_t>(samples_ / 4, 1, first_batch);
    return std::min(std::max(first, grown), samples_ - before_);
}

uint64_t SamplePlan::most_passes() const {
    // batches never shrink, but for the last, and a batch may end in a short pass
    const uint64_t passes = samples_ / pass_samples_ + samples_ / first_batch + 8;
    return samples_ == 0 ? most_rows : std::min<uint64_t>(most_rows, passes);
}

std::vector<PlanRow> SamplePlan::take(uint64_t count) {
    std::vector<PlanRow> rows;
    while (rows.size() < count && !done()) {
        const uint64_t size = batch_size();
        PlanRow row{};
        row.first_sample = static_cast<uint32_t>(taken_);
        row.batch_start = static_cast<uint32_t>(before_);
        row.samples = static_cast<uint32_t>(std::min(pass_samples_, size - in_batch_));
        in_batch_ += row.samples;
        taken_ += row.samples;
        if (in_batch_ == size) {
            row.closes_batch = static_cast<uint32_t>(size);
            ++batches_;
            before_ += size;
            in_batch_ = 0;
        }
        rows.push_back(row);
    }
    return rows;
}

}  // namespace wavepath
