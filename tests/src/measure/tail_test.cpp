#include "measure/tail.h"

#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace wavepath {
namespace {

using Draw = std::function<double(std::mt19937_64&)>;

double pareto(double index, std::mt19937_64& random) {
    return std::pow(std::uniform_real_distribution<double>(1e-300, 1)(random), -1 / index);
}

// Deviations from the sample's own mean, as an error has them.
std::vector<double> deviations(const Draw& draw, std::size_t count, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> values(count);
    for (double& x : values) x = draw(random);
    const double mean = mean_interval(values).value;
    for (double& x : values) x -= mean;
    return values;
}

int flagged(const Draw& draw, std::size_t count) {
    int flags = 0;
    for (uint64_t seed = 0; seed < 200; ++seed)
        flags += tail_of(deviations(draw, count, seed)).infinite_variance ? 1 : 0;
    return flags;
}

TEST(Tail, OfParetoBelowTwoHasInfiniteVariance) {
    const Draw draw = [](std::mt19937_64& random) { return pareto(1.5, random); };
    EXPECT_EQ(flagged(draw, 150000), 200);
}

TEST(Tail, OfFiniteVarianceIsNeverFlagged) {
    const std::vector<std::pair<const char*, Draw>> laws{
        {"normal", [](auto& random) { return std::normal_distribution<double>()(random); }},
        {"uniform", [](auto& random) { return std::uniform_real_distribution<double>()(random); }},
        {"exponential",
         [](auto& random) { return std::exponential_distribution<double>()(random); }},
        {"lognormal", [](auto& random) { return std::lognormal_distribution<double>()(random); }},
        {"rare", [](auto& random) { return std::gamma_distribution<double>(0.03)(random); }},
        {"discrete", [](auto& random) { return std::poisson_distribution<int>(0.1)(random); }},
        {"Student's t of 3",
         [](auto& random) { return std::student_t_distribution<double>(3)(random); }},
        {"Pareto of 2.5", [](auto& random) { return pareto(2.5, random); }}};
    for (const auto& [name, draw] : laws) EXPECT_EQ(flagged(draw, 30000), 0) << name;
}

// Of 200 intervals 190 +- 3.1 hold the truth; alpha = 6e-7 below 174.
TEST(Tail, IntervalHoldsTheIndex) {
    for (const double index : {1.5, 3.0}) {
        int hits = 0;
        for (uint64_t seed = 0; seed < 200; ++seed) {
            const Interval found =
                tail_of(deviations([&](auto& r) { return pareto(index, r); }, 30000, seed)).index;
            hits += found.low <= index && index <= found.high ? 1 : 0;
        }
        EXPECT_GT(hits, 174) << index;
    }
}

TEST(Tail, OfOneLargeValueIsThat) {
    std::vector<double> values(100, 0.0);
    values[7] = -3;
    EXPECT_EQ(tail_of(values).share_of_largest, 1);
    EXPECT_DOUBLE_EQ(tail_of(values).variance_of_variance, 1 - 0.01);
    values[8] = 3;
    EXPECT_EQ(tail_of(values).share_of_largest, 0.5);
    EXPECT_TRUE(std::isnan(tail_of(values).index.value));
    EXPECT_FALSE(tail_of(values).infinite_variance);
    EXPECT_EQ(tail_of({}).share_of_largest, 0);
}

}  // namespace
}  // namespace wavepath
