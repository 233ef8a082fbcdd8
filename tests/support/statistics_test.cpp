#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace wavepath {
namespace {

TEST(Statistics, ChiSquarePValues) {
    // two degrees of freedom: exp(-x / 2)
    for (const double x : {0.01, 1.0, 3.0, 10.0, 50.0, 300.0})
        EXPECT_NEAR(chi_square_p_value(x, 2) / std::exp(-0.5 * x), 1, 1e-12) << x;
    // one: erfc(sqrt(x / 2))
    for (const double x : {0.01, 1.0, 3.0, 10.0, 50.0})
        EXPECT_NEAR(chi_square_p_value(x, 1) / std::erfc(std::sqrt(0.5 * x)), 1, 1e-12) << x;
    // even degrees: a Poisson sum; 100 degrees at 150
    double term = std::exp(-75.0);
    double sum = term;
    for (int k = 1; k < 50; ++k) sum += term *= 75.0 / k;
    EXPECT_NEAR(chi_square_p_value(150, 100) / sum, 1, 1e-10);
    // far degrees: the law is nearly normal around its median, degrees - 2/3
    EXPECT_NEAR(chi_square_p_value(6000.0 - 2.0 / 3.0, 6000), 0.5, 1e-5);
}

TEST(Statistics, CriticalValues) {
    EXPECT_NEAR(normal_critical(0.025), 1.959963984540054, 1e-12);
    EXPECT_NEAR(normal_critical(0.5e-6), 4.891638475699066, 1e-9);
    // one degree of freedom is Cauchy's law, two have a closed form
    for (const double p : {0.4, 0.1, 0.01, 1e-4}) {
        EXPECT_NEAR(student_critical(p, 1) * std::tan(M_PI * p), 1, 1e-9) << p;
        const double t = (1 - 2 * p) / std::sqrt(2 * p * (1 - p));
        EXPECT_NEAR(student_critical(p, 2) / t, 1, 1e-9) << p;
    }
    // two-sided 1e-6 with 32 and 128 batches
    EXPECT_NEAR(student_critical(0.5e-6, 31), 6.072, 5e-4);
    EXPECT_NEAR(student_critical(0.5e-6, 127), 5.142, 5e-4);
    EXPECT_NEAR(normal_critical(0.5 * sidak(1e-6, 100)), 5.7307, 5e-5);
}

TEST(Statistics, MomentsOfASmallSpreadOnALargeMean) {
    Moments moments;
    for (int i = 0; i < 1000; ++i) moments.add(1e9 + i % 2);
    EXPECT_DOUBLE_EQ(moments.mean(), 1e9 + 0.5);
    EXPECT_NEAR(moments.variance(), 0.25 * 1000 / 999, 1e-6);
}

// The tests themselves must fail for a bias of the size they promise to find.
TEST(Statistics, BiasIsFound) {
    std::mt19937 random(1);
    std::exponential_distribution<double> exponential(1);
    Moments batches;
    for (int b = 0; b < 1024; ++b) {
        Moments batch;
        for (int i = 0; i < 2560; ++i) batch.add(exponential(random));
        batches.add(batch.mean());
    }
    EXPECT_TRUE(mean_is(batches, 1, 1, 0.005));
    EXPECT_FALSE(mean_is(batches, 1.005, 1, 0.005));
    EXPECT_FALSE(mean_is(batches, 1, 1, 0.002)) << "claims more power than it has";
}

TEST(Statistics, TiltedCountsAreFound) {
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> die(0, 99);
    std::vector<uint32_t> counts(100);
    for (int i = 0; i < 1'000'000; ++i) ++counts[die(random)];
    std::vector<double> expected(100, 1e4);
    EXPECT_TRUE(counts_follow(counts, expected, 1));
    for (std::size_t k = 0; k < 100; ++k) expected[k] *= k < 50 ? 1.015 : 0.985;
    EXPECT_FALSE(counts_follow(counts, expected, 1));
    expected.assign(100, 1e6 / 99);
    expected[3] = 0;
    EXPECT_FALSE(counts_follow(counts, expected, 1)) << "samples where none may be";
}

}  // namespace
}  // namespace wavepath
