// Tests of hypotheses. All seeds are fixed, so a test that passes once passes always; the levels
// say how surprising a failure is after kernels or seeds change.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavepath {

// Chance that a TEST fails by bad luck; its comparisons share it (sidak).
inline constexpr double false_alarm = 1e-6;

// Mean and variance by Welford's recurrence.
class Moments {
  public:
    void add(double x);

    std::size_t count() const { return count_; }
    double mean() const { return mean_; }
    double variance() const;        // of one x, unbiased
    double standard_error() const;  // of the mean

  private:
    std::size_t count_ = 0;
    double mean_ = 0;
    double squares_ = 0;  // sum of (x - mean)^2
};

// Level of each of `comparisons` independent comparisons that together fail by chance with
// probability `level`.
double sidak(double level, std::size_t comparisons);

// x with P(X > x) = p, 0 < p <= 1/2.
double normal_critical(double p);
double student_critical(double p, double degrees);

// P(X > statistic) for chi-square: the regularised upper incomplete gamma function.
double chi_square_p_value(double statistic, double degrees);

// Whether the mean of independent batches agrees with `truth`: a t-test at false_alarm shared by
// `comparisons` (at least 128 batches). With `bias` > 0 also whether the test is strong enough to
// find that relative bias with probability 0.99; not asked of a scaled-down run. `tolerance` [1] is
// relative: digits of the truth, rounding of the floats summed; far below any bias looked for.
testing::AssertionResult mean_is(
    const Moments& batches,
    double truth,
    std::size_t comparisons,
    double bias = 0,
    double tolerance = 4e-6);

// Pearson's test of counts against expected counts. Cells are pooled by rising expectation until
// each holds 5 or more; counts where nothing is expected fail at once, but for a share of 5e-6:
// quadrature misses corners of cells.
testing::AssertionResult counts_follow(
    const std::vector<uint32_t>& counts,
    const std::vector<double>& expected,
    std::size_t comparisons);

}  // namespace wavepath
