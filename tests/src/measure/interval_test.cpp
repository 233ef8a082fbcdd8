#include "measure/interval.h"

#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace wavepath {
namespace {

TEST(StudentQuantile, IsThatOfTheDistribution) {
    for (const std::size_t degrees : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 10U, 30U, 1000U})
        EXPECT_NEAR(
            student_quantile(degrees), student_critical(0.025, static_cast<double>(degrees)), 1e-3)
            << degrees;
}

// How many of 1000 intervals hold the truth: 950 +- 7 if 95 % do.
template <typename Trial>
int covered(const Trial& trial, double truth) {
    int hits = 0;
    for (uint64_t seed = 0; seed < 1000; ++seed) {
        std::mt19937_64 random(seed);
        const Interval interval = trial(random);
        if (interval.low <= truth && truth <= interval.high) ++hits;
    }
    return hits;
}

// Within 950 +- 34, which is five standard deviations: alpha = 6e-7.
TEST(MeanInterval, HoldsTheMeanIn95Of100) {
    const int hits = covered(
        [](std::mt19937_64& random) {
            std::normal_distribution<double> normal(3, 2);
            std::vector<double> values(4);
            for (double& x : values) x = normal(random);
            return mean_interval(values);
        },
        3);
    EXPECT_GT(hits, 950 - 34);
    EXPECT_LT(hits, 950 + 34);
}

TEST(LogSlope, HoldsTheSlopeIn95Of100) {
    const int hits = covered(
        [](std::mt19937_64& random) {
            std::normal_distribution<double> normal(0, 0.2);
            std::vector<double> x;
            std::vector<double> y;
            for (const double n : {1, 2, 4, 8, 16, 32}) {
                x.push_back(n);
                y.push_back(7 * std::pow(n, -1.3) * std::exp(normal(random)));
            }
            return log_slope(x, y);
        },
        -1.3);
    EXPECT_GT(hits, 950 - 34);
    EXPECT_LT(hits, 950 + 34);
}

TEST(LogSlope, OfAPowerIsExact) {
    const Interval slope = log_slope({1, 10, 100, 1000}, {5, 0.5, 0.05, -1});
    EXPECT_NEAR(slope.value, -1, 1e-12);
    EXPECT_NEAR(slope.high - slope.low, 0, 1e-9);
}

TEST(LogSlope, OfTooFewPointsIsUnknown) {
    EXPECT_TRUE(std::isnan(log_slope({1}, {1}).value));
    EXPECT_TRUE(std::isnan(log_slope({2, 2}, {1, 3}).value));
    EXPECT_EQ(log_slope({1, 2}, {1, 2}).high, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace wavepath
