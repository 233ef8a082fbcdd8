#include "measure/picture_error.h"

#include "measure/pixels.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace wavepath {

namespace {

// Keeps the relative error of black pixels finite [radiance^2].
constexpr double black = 0.01;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Mean of term(radiances...) over channels and finite pixels.
template <typename Term, typename... Images>
PictureError mean_over_pixels(const Term& term, const Images&... images) {
    double sum = 0;
    std::size_t count = 0;
    const std::size_t left_out = visit_finite_pixels(
        [&](std::size_t, const auto&... radiances) {
            for (std::size_t c = 0; c < 3; ++c) sum += term(radiances[c]...);
            count += 3;
        },
        images...);
    return {count > 0 ? sum / static_cast<double>(count) : nan, left_out};
}

double sum_of(const Radiance& v) {
    return v[0] + v[1] + v[2];
}

}  // namespace

PictureError mse(const Image& a, const Image& reference) {
    return mse(a, reference, reference);
}

PictureError rel_mse(const Image& a, const Image& reference) {
    return rel_mse(a, reference, reference);
}

PictureError mse(const Image& a, const Image& half1, const Image& half2) {
    return mean_over_pixels(
        [](double x, double r1, double r2) { return (x - r1) * (x - r2); }, a, half1, half2);
}

PictureError rel_mse(const Image& a, const Image& half1, const Image& half2) {
    return mean_over_pixels(
        [](double x, double r1, double r2) {
            const double r = 0.5 * (r1 + r2);
            return (x - r1) * (x - r2) / (r * r + black);
        },
        a, half1, half2);
}

PictureError rel_mse_of_halves(const Image& half1, const Image& half2) {
    return mean_over_pixels(
        [](double r1, double r2) {
            const double r = 0.5 * (r1 + r2);
            return 0.25 * (r1 - r2) * (r1 - r2) / (r * r + black);
        },
        half1, half2);
}

Ratio ratio_of_means(const Image& a, const Image& b) {
    double sum_a = 0;
    double sum_b = 0;
    Ratio ratio;
    ratio.left_out = visit_finite_pixels(
        [&](std::size_t, const Radiance& x, const Radiance& y) {
            sum_a += sum_of(x);
            sum_b += sum_of(y);
        },
        a, b);
    if (sum_b == 0) return {nan, nan, ratio.left_out};
    ratio.value = sum_a / sum_b;
    double squares = 0;
    visit_finite_pixels(
        [&](std::size_t, const Radiance& x, const Radiance& y) {
            const double rest = sum_of(x) - ratio.value * sum_of(y);
            squares += rest * rest;
        },
        a, b);
    ratio.standard_error = std::sqrt(squares) / std::abs(sum_b);
    return ratio;
}

Image variance_over(const std::vector<Image>& pictures) {
    assert(pictures.size() >= 2);
    const auto count = static_cast<double>(pictures.size());
    Image variance{
        .width = pictures.front().width,
        .height = pictures.front().height,
        .channels = {},
        .metadata = {}};
    for (const char* channel : {"R", "G", "B"}) {
        std::vector<float>& plane = variance.channels[channel];
        plane.resize(std::size_t{variance.width} * variance.height);
        for (std::size_t i = 0; i < plane.size(); ++i) {
            double mean = 0;
            for (const Image& picture : pictures) mean += picture.channels.at(channel)[i] / count;
            double squares = 0;
            for (const Image& picture : pictures)
                squares += std::pow(picture.channels.at(channel)[i] - mean, 2);
            plane[i] = static_cast<float>(squares / (count - 1));
        }
    }
    return variance;
}

std::vector<double> relative_deviations(const Image& a, const Image& reference) {
    std::vector<double> deviations;
    visit_finite_pixels(
        [&](std::size_t, const Radiance& x, const Radiance& r) {
            for (std::size_t c = 0; c < 3; ++c)
                deviations.push_back((x[c] - r[c]) / std::sqrt(r[c] * r[c] + black));
        },
        a, reference);
    return deviations;
}

}  // namespace wavepath
