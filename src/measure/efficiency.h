// What a method makes of its time.
#pragma once

#include "measure/interval.h"

#include <vector>

namespace wavepath {

// 1 / (relMSE x time) [1/s] of renders by K seeds: 1 / (mean of rel_mse * mean of seconds). A
// method of twice the efficiency needs half the time for the same error. The interval is one of its
// logarithm, by the delta method and Student's t of K - 1 degrees, which holds its 95 % from a few
// seeds on, where resampling so few has too narrow intervals. All of `seconds` have to be above 0.
// All is NaN where the mean error is not above 0 or not finite: the reference is too noisy, or the
// estimate broken. 0 to infinity for K = 1.
Interval efficiency(const std::vector<double>& rel_mse, const std::vector<double>& seconds);

// Efficiency of one method over that of another [1]: the interval combines both, so that a winner
// is one whose interval leaves 1 out. Takes what `efficiency` returned.
Interval efficiency_ratio(const Interval& of, const Interval& over);

}  // namespace wavepath
