#include "measure/tail.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace wavepath {

namespace {

constexpr std::size_t least_count = 30000;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// xi = 1 / alpha of the generalised Pareto distribution of rising values above 0, the mean of the
// posterior under a weak prior [Zhang & Stephens 2009].
double pareto_shape(const std::vector<double>& excesses) {
    const std::size_t n = excesses.size();
    const auto mean_log = [&](double theta) {
        double sum = 0;
        for (const double x : excesses) sum += std::log1p(-theta * x);
        return sum / static_cast<double>(n);
    };
    const double quartile = excesses[(n + 2) / 4 - 1];
    const auto candidates = 30 + static_cast<std::size_t>(std::sqrt(n));
    std::vector<double> thetas;
    std::vector<double> likelihoods;  // logarithms
    for (std::size_t j = 0; j < candidates; ++j) {
        const double rank = static_cast<double>(candidates) / (static_cast<double>(j) + 0.5);
        const double theta = 1 / excesses.back() + (1 - std::sqrt(rank)) / (3 * quartile);
        const double shape = mean_log(theta);
        thetas.push_back(theta);
        likelihoods.push_back(static_cast<double>(n) * (std::log(-theta / shape) - shape - 1));
    }
    const double most = *std::ranges::max_element(likelihoods);
    double weights = 0;
    double theta = 0;
    for (std::size_t j = 0; j < candidates; ++j) {
        const double weight = std::exp(likelihoods[j] - most);
        weights += weight;
        theta += weight * thetas[j];
    }
    return mean_log(theta / weights);
}

// By the `count` largest of falling values; NaN where most of those are one value.
Interval index_of_largest(const std::vector<double>& values, std::size_t count) {
    std::vector<double> excesses;
    for (std::size_t i = count; i-- > 0;)
        if (values[i] > values[count]) excesses.push_back(values[i] - values[count]);
    if (excesses.size() < count / 2) return {nan, nan, nan};
    const double shape = pareto_shape(excesses);
    constexpr double normal_quantile = 1.959964;
    const double half =
        normal_quantile * (1 + shape) / std::sqrt(static_cast<double>(excesses.size()));
    const auto inverse = [](double xi) {
        return xi > 0 ? 1 / xi : std::numeric_limits<double>::infinity();
    };
    return {inverse(shape), inverse(shape + half), inverse(shape - half)};
}

}  // namespace

Tail tail_of(const std::vector<double>& deviations) {
    // A random factor of 1 to 2 leaves the index as it is [Breiman 1965] and parts values that are
    // alike, as those of paths that differ by their length only.
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> exponent;
    std::vector<double> sizes;
    double largest = 0;
    double squares = 0;
    double fourths = 0;
    for (const double x : deviations) {
        sizes.push_back(std::abs(x) * std::exp2(exponent(random)));
        largest = std::max(largest, x * x);
        squares += x * x;
        fourths += x * x * x * x;
    }
    Tail tail{.index = {nan, nan, nan}};
    if (!(squares > 0)) return tail;
    const auto n = static_cast<double>(sizes.size());
    tail.share_of_largest = largest / squares;
    tail.variance_of_variance = fourths / (squares * squares) - 1 / n;

    if (sizes.size() < least_count) return tail;
    const auto count = static_cast<std::size_t>(6 * std::sqrt(n));
    std::ranges::partial_sort(
        sizes, sizes.begin() + static_cast<std::ptrdiff_t>(count) + 1, std::greater{});
    tail.index = index_of_largest(sizes, count);
    tail.infinite_variance = tail.index.high < 2 && index_of_largest(sizes, count / 2).value < 2;
    return tail;
}

}  // namespace wavepath
