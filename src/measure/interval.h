// Numbers with the intervals that hold their expected value in 95 of 100 cases.
#pragma once

#include <cstddef>
#include <vector>

namespace wavepath {

struct Interval {
    double value = 0;
    double low = 0, high = 0;
};

// The 0.975 quantile of Student's t of this many degrees of freedom, to 1e-3; infinite for 0.
double student_quantile(std::size_t degrees);

// Mean of independent values, by Student's t. The interval is infinite for one value, NaN for none.
Interval mean_interval(const std::vector<double>& values);

// d log(y) / d log(x) of the least-squares line, by Student's t of n - 2 degrees: the order in
// which an error falls. Scatter around the line has to be independent and alike in the logarithm,
// so give one point a picture, or a median over seeds, and leave out points below the floor of the
// reference. Points with x or y not above 0, or not finite, are left out. The interval is infinite
// for two points; all is NaN for fewer, or where all x are equal.
Interval log_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace wavepath
