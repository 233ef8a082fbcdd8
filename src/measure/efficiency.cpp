#include "measure/efficiency.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace wavepath {

Interval efficiency(const std::vector<double>& rel_mse, const std::vector<double>& seconds) {
    assert(rel_mse.size() == seconds.size());
    const double error = mean_interval(rel_mse).value;
    const double time = mean_interval(seconds).value;
    const double value = 1 / (error * time);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (!(value > 0 && std::isfinite(value))) return {nan, nan, nan};
    // -log(error * time) to first order in what the seeds change.
    std::vector<double> logarithm;
    for (std::size_t k = 0; k < rel_mse.size(); ++k)
        logarithm.push_back(2 - rel_mse[k] / error - seconds[k] / time);
    const Interval spread = mean_interval(logarithm);  // around 0
    return {value, value * std::exp(spread.low), value * std::exp(spread.high)};
}

Interval efficiency_ratio(const Interval& of, const Interval& over) {
    const double value = of.value / over.value;
    const double low = std::hypot(std::log(of.value / of.low), std::log(over.high / over.value));
    const double high = std::hypot(std::log(of.high / of.value), std::log(over.value / over.low));
    return {value, value * std::exp(-low), value * std::exp(high)};
}

}  // namespace wavepath
