#include "support/statistics.h"

#include "support/probe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace wavepath {

namespace {

constexpr double power_quantile = 2.3263478740408408;  // normal, .99

// Share of samples allowed where nothing is expected.
constexpr double missed_share = 5e-6;

// Smallest x in [0, infinity) with tail(x) <= p, for a falling tail.
template <typename Tail>
double solve_tail(const Tail& tail, double p) {
    double high = 1;
    while (tail(high) > p) high *= 2;
    double low = 0;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
        const double middle = 0.5 * (low + high);
        (tail(middle) > p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// Continued fraction b0 + a1 / (b1 + a2 / (b2 + ...)) by Lentz's recurrence; `term(k)` gives {a_k,
// b_k}.
template <typename Term>
double continued_fraction(double b0, const Term& term) {
    constexpr double tiny = 1e-300;
    double value = b0 != 0 ? b0 : tiny;
    double c = value;
    double d = 0;
    for (int k = 1; k < 100000; ++k) {
        const auto [a, b] = term(k);
        d = b + a * d;
        d = 1 / (d != 0 ? d : tiny);
        c = b + a / c;
        c = c != 0 ? c : tiny;
        const double factor = c * d;
        value *= factor;
        if (std::abs(factor - 1) < 1e-15) break;
    }
    return value;
}

struct Term {
    double a, b;
};

// Regularised incomplete beta function I_x(a, b), x < (a + 1) / (a + b + 2).
double incomplete_beta(double x, double a, double b) {
    const double front = std::exp(
        std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) +
        b * std::log1p(-x));
    const double fraction = continued_fraction(1, [&](int k) {
        const int m = k / 2;
        const double top = k % 2 == 0
                               ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                               : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        return Term{top, 1};
    });
    return front / (a * fraction);
}

double student_tail(double t, double degrees) {
    const double x = degrees / (degrees + t * t);
    const double a = 0.5 * degrees;
    const double both =
        x < (a + 1) / (a + 2.5) ? incomplete_beta(x, a, 0.5) : 1 - incomplete_beta(1 - x, 0.5, a);
    return 0.5 * both;
}

}  // namespace

void Moments::add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (x - mean_);
}

double Moments::variance() const {
    return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0;
}

double Moments::standard_error() const {
    return std::sqrt(variance() / static_cast<double>(count_));
}

double sidak(double level, std::size_t comparisons) {
    return -std::expm1(std::log1p(-level) / static_cast<double>(comparisons));
}

double normal_critical(double p) {
    return solve_tail([](double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); }, p);
}

double student_critical(double p, double degrees) {
    return solve_tail([&](double t) { return student_tail(t, degrees); }, p);
}

double chi_square_p_value(double statistic, double degrees) {
    const double a = 0.5 * degrees;
    const double x = 0.5 * statistic;
    if (x <= 0) return 1;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a;
        double sum = term;
        for (double k = a + 1; term > 1e-17 * sum; ++k) sum += term *= x / k;
        return 1 - front * sum;
    }
    const double fraction = continued_fraction(x + 1 - a, [&](int k) {
        return Term{-k * (k - a), x + 2 * k + 1 - a};
    });
    return front / fraction;
}

testing::AssertionResult mean_is(
    const Moments& batches, double truth, std::size_t comparisons, double bias, double tolerance) {
    if (batches.count() < 128)
        return testing::AssertionFailure() << batches.count() << " batches; 128 are needed";
    const double critical = student_critical(
        0.5 * sidak(false_alarm, comparisons), static_cast<double>(batches.count() - 1));
    const double error = batches.standard_error();
    // a scaled-down run looks for faults of memory: too short for events as rare as the tests'
    // powers
    if (test_scale() < 1) tolerance = std::max(tolerance, 0.02);
    if (!(std::abs(batches.mean() - truth) <= critical * error + tolerance * std::abs(truth)))
        return testing::AssertionFailure()
               << "mean " << batches.mean() << " +- " << error << ", expected " << truth
               << ": off by " << (batches.mean() - truth) / error << " standard errors, "
               << critical << " allowed";
    const double found = (critical + power_quantile) * error;
    if (bias > 0 && test_scale() >= 1 && !(found <= bias * std::abs(truth)))
        return testing::AssertionFailure()
               << "too weak: finds a bias of " << found / std::abs(truth) << ", not of " << bias
               << "; more samples by " << std::pow(found / (bias * truth), 2);
    return testing::AssertionSuccess();
}

testing::AssertionResult counts_follow(
    const std::vector<uint32_t>& counts,
    const std::vector<double>& expected,
    std::size_t comparisons) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t cell) { return expected[cell]; });

    double statistic = 0;
    double cells = 0;
    double pooled_count = 0;
    double pooled = 0;
    double impossible = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t cell = order[k];
        if (expected[cell] <= 0) {
            impossible += counts[cell];
            continue;
        }
        pooled_count += counts[cell];
        pooled += expected[cell];
        // the last cell's pool may stay short: its few samples are then left out
        if (pooled < 5) continue;
        statistic += (pooled_count - pooled) * (pooled_count - pooled) / pooled;
        ++cells;
        pooled_count = 0;
        pooled = 0;
    }
    const double samples = std::accumulate(counts.begin(), counts.end(), 0.0);
    if (impossible > missed_share * samples)
        return testing::AssertionFailure() << impossible << " samples where the density is 0";
    if (cells < 2) return testing::AssertionSuccess() << "nothing to compare";
    const double p = chi_square_p_value(statistic, cells - 1);
    if (p > sidak(false_alarm, comparisons)) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "chi-square " << statistic << " over " << cells << " cells: p = " << p;
}

}  // namespace wavepath
