// Whether a mean can be trusted: how heavy the tail is that its samples come from.
#pragma once

#include "measure/interval.h"

#include <vector>

namespace wavepath {

struct Tail {
    // alpha with P(|x| > t) ~ t^-alpha: the variance is infinite below 2, the mean below 1.
    // Infinite where the tail ends, or falls faster than any power. NaN for fewer than 30000 values
    // and where most of the largest deviations are 0.
    Interval index;
    // The whole interval is below 2, and so is what the larger half of the tail says by itself: a
    // law that only begins like a power of below 2 is not flagged.
    bool infinite_variance = false;
    // Share of the sum of squares that the largest square makes [1].
    double share_of_largest = 0;
    // Relative variance of the variance, sum x^4 / (sum x^2)^2 - 1 / n [1]: 2 / n of Gaussian
    // values; above 0.1 [Briesmeister 2000] neither the variance nor an error from it means much.
    double variance_of_variance = 0;
};

// Of deviations from a mean, such as relative_deviations of some seeds: independent, of one law or
// of laws that differ in scale by little. The index is 1 / shape of the generalised Pareto
// distribution of the largest 6 sqrt(n) of them, fitted by [Zhang & Stephens 2009] as [Vehtari
// 2024] does to judge Monte Carlo estimates; unlike Hill's estimator it does not depend on what the
// mean was. Events so rare that fewer than some hundred are among the values can seem heavier than
// they are.
Tail tail_of(const std::vector<double>& deviations);

}  // namespace wavepath
