#include "wavefront/sample_plan.h"

#include <algorithm>
#include <bit>

namespace wavepath {

SamplePlan::SamplePlan(uint64_t samples)
    : samples_(samples),
      batch_count_(static_cast<uint32_t>(std::min(
          samples, std::clamp<uint64_t>(samples / least_batch, least_batches, most_batches)))) {}

uint32_t SamplePlan::batch_size() const {
    if (samples_ == 0)  // open-ended: the longer the batches, the closer the bound
        return std::max(least_batch, std::bit_floor(before_ / 8));
    return static_cast<uint32_t>(
        samples_ / batch_count_ + (batch_ < samples_ % batch_count_ ? 1 : 0));
}

uint64_t SamplePlan::most_passes() const {
    const uint64_t passes = samples_ / pass_samples + batch_count_;
    return samples_ == 0 ? most_rows : std::min<uint64_t>(most_rows, passes);
}

std::vector<PlanRow> SamplePlan::take(uint64_t count) {
    std::vector<PlanRow> rows;
    while (rows.size() < count && !done()) {
        const uint32_t size = batch_size();
        PlanRow row{};
        row.first_sample = static_cast<uint32_t>(taken_);
        row.batch_start = before_;
        row.samples = std::min(pass_samples, size - in_batch_);
        in_batch_ += row.samples;
        taken_ += row.samples;
        if (in_batch_ == size) {
            row.closes_batch = size;
            ++batch_;
            before_ += size;
            in_batch_ = 0;
        }
        rows.push_back(row);
    }
    return rows;
}

}  // namespace wavepath
