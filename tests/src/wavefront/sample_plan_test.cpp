#include "wavefront/sample_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wavepath {
namespace {

TEST(SamplePlan, TakesEverySampleOnceInOrder) {
    for (const uint64_t samples : {1U, 2U, 13U, 64U, 70U, 1000U, 4099U}) {
        for (const uint64_t pixels : {1U, 65536U, 500000U, 3000000U}) {
            SCOPED_TRACE(samples);
            SamplePlan plan(samples, pixels);
            uint64_t next = 0;
            uint64_t closed = 0;
            uint64_t rows = 0;
            while (!plan.done()) {
                for (const PlanRow& row : plan.take(3)) {
                    EXPECT_EQ(row.first_sample, next);
                    EXPECT_EQ(row.batch_start, closed);
                    EXPECT_LE(row.samples * pixels, std::max<uint64_t>(pixels, 1U << 21U));
                    next += row.samples;
                    closed += row.closes_batch;
                    ++rows;
                }
            }
            EXPECT_EQ(next, samples);
            EXPECT_EQ(closed, samples) << "the last batch stays open";
            EXPECT_LE(rows, plan.most_passes());
            EXPECT_GE(plan.batches_closed(), std::min<uint64_t>(samples, 4));
        }
    }
}

TEST(SamplePlan, BatchesGrowWithTheSamplesTaken) {
    SamplePlan plan(0, 1000);
    while (plan.samples_taken() < 10000) plan.take(100);
    EXPECT_FALSE(plan.done());
    EXPECT_GE(plan.batches_closed(), 8U * 6);
    EXPECT_LE(plan.batches_closed(), 8U * 9);
}

}  // namespace
}  // namespace wavepath
