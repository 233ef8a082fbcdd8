#include "measure/interval.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace wavepath {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Interval around(double value, double standard_error, std::size_t degrees) {
    if (degrees == 0) return {value, -infinity, infinity};
    const double half = student_quantile(degrees) * standard_error;
    return {value, value - half, value + half};
}

}  // namespace

double student_quantile(std::size_t degrees) {
    constexpr std::array table{infinity, 12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469};
    if (degrees < table.size()) return table[degrees];
    // The expansion in 1 / degrees [Abramowitz & Stegun, 26.7.5].
    constexpr double z = 1.959964;
    constexpr double z3 = z * z * z;
    constexpr double z5 = z3 * z * z;
    constexpr double z7 = z5 * z * z;
    const auto n = static_cast<double>(degrees);
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

Interval mean_interval(const std::vector<double>& values) {
    if (values.empty()) return {nan, nan, nan};
    const auto count = static_cast<double>(values.size());
    double mean = 0;
    for (const double x : values) mean += x / count;
    double squares = 0;
    for (const double x : values) squares += (x - mean) * (x - mean);
    return around(mean, std::sqrt(squares / (count - 1) / count), values.size() - 1);
}

Interval log_slope(const std::vector<double>& x, const std::vector<double>& y) {
    assert(x.size() == y.size());
    std::vector<double> u;
    std::vector<double> v;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0 && y[i] > 0 && std::isfinite(x[i]) && std::isfinite(y[i]))) continue;
        u.push_back(std::log(x[i]));
        v.push_back(std::log(y[i]));
    }
    if (u.size() < 2) return {nan, nan, nan};
    const double mean_u = mean_interval(u).value;
    const double mean_v = mean_interval(v).value;
    double uu = 0;
    double uv = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        uu += (u[i] - mean_u) * (u[i] - mean_u);
        uv += (u[i] - mean_u) * (v[i] - mean_v);
    }
    if (uu == 0) return {nan, nan, nan};
    const double slope = uv / uu;
    double squares = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
        squares += std::pow(v[i] - mean_v - slope * (u[i] - mean_u), 2);
    const std::size_t degrees = u.size() - 2;
    return around(slope, std::sqrt(squares / static_cast<double>(degrees) / uu), degrees);
}

}  // namespace wavepath
