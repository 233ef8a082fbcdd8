#include "measure/efficiency.h"

#include "measure/picture_error.h"
#include "support/noisy_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace wavepath {
namespace {

struct Series {
    std::vector<double> rel_mse, seconds;
};

// Five renders of this noise and time, by a reference of two noisy halves.
Series renders(const Image& truth, double noise, double time, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> jitter(1, 0.02);
    const Image half1 = noisy_picture(truth, 0.05, random());
    const Image half2 = noisy_picture(truth, 0.05, random());
    Series series;
    for (int k = 0; k < 5; ++k) {
        series.rel_mse.push_back(
            rel_mse(noisy_picture(truth, noise, random()), half1, half2).value);
        series.seconds.push_back(time * jitter(random));
    }
    return series;
}

Interval efficiency_of(const Series& series) {
    return efficiency(series.rel_mse, series.seconds);
}

// One method has half the variance in three times the time, so 2/3 of the efficiency.
TEST(Efficiency, RatioIsThatOfVarianceTimesTime) {
    const Image truth = lamp_picture(64);
    const Interval quick = efficiency_of(renders(truth, 0.2, 1, 1));
    const Interval slow = efficiency_of(renders(truth, 0.2 / std::sqrt(2), 3, 2));
    const Interval ratio = efficiency_ratio(slow, quick);
    EXPECT_NEAR(ratio.value, 2.0 / 3, 0.05 * 2.0 / 3);
    EXPECT_LT(ratio.low, 2.0 / 3);
    EXPECT_GT(ratio.high, 2.0 / 3);
    EXPECT_LT(ratio.high, 1);
}

// Over 400 trials of five renders: 380 +- 4.4 have the truth inside; 22 is five of those, so
// alpha = 6e-7.
TEST(Efficiency, HoldsTheTruthIn95Of100) {
    const Image truth = even_picture(8, 8, 1);
    const double expected = 1 / (0.04 / 1.01 * 2);
    int hits = 0;
    for (uint64_t seed = 0; seed < 400; ++seed) {
        const Interval interval = efficiency_of(renders(truth, 0.2, 2, seed));
        if (interval.low <= expected && expected <= interval.high) ++hits;
    }
    EXPECT_GT(hits, 380 - 22);
    EXPECT_LE(hits, 380 + 20);
}

TEST(Efficiency, BelowTheReferenceIsUnknown) {
    EXPECT_TRUE(std::isnan(efficiency({-0.1, 0.05}, {1, 1}).value));
}

}  // namespace
}  // namespace wavepath
