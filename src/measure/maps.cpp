#include "measure/maps.h"

#include "measure/pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace wavepath {

namespace {

double mean_of(const Radiance& v) {
    return (v[0] + v[1] + v[2]) / 3;
}

std::vector<double> unknown(const Image& image) {
    return std::vector<double>(
        std::size_t{image.width} * image.height, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::vector<double> relative_differences(const Image& a, const Image& b) {
    std::vector<double> values = unknown(a);
    visit_finite_pixels(
        [&](std::size_t i, const Radiance& x, const Radiance& y) {
            const double mean = 0.5 * (std::abs(mean_of(x)) + std::abs(mean_of(y)));
            values[i] = (mean_of(x) - mean_of(y)) / (mean + 0.1);
        },
        a, b);
    return values;
}

std::optional<std::vector<double>> z_scores(const Image& a, const Image& b) {
    for (const Image* image : {&a, &b})
        for (const char* channel : {"variance.R", "variance.G", "variance.B"})
            if (!image->channels.contains(channel)) return std::nullopt;
    std::vector<double> values = unknown(a);
    visit_finite_pixels(
        [&](std::size_t i, const Radiance& x, const Radiance& y) {
            double variance = 0;
            for (const Image* image : {&a, &b}) {
                double error = 0;
                for (const char* channel : {"variance.R", "variance.G", "variance.B"})
                    error += std::sqrt(image->channels.at(channel)[i]) / 3;
                variance += error * error;
            }
            const double difference = mean_of(x) - mean_of(y);
            values[i] = difference == 0 ? 0 : difference / std::sqrt(variance);
        },
        a, b);
    return values;
}

Image signed_picture(
    uint32_t width, uint32_t height, const std::vector<double>& values, double full) {
    // Of the palette of [Okabe and Ito 2008], linear.
    constexpr Radiance vermilion{0.665, 0.112, 0};
    constexpr Radiance blue{0, 0.168, 0.445};
    Image image{.width = width, .height = height, .channels = {}, .metadata = {}};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& plane = image.channels[std::string(1, "RGB"[c])];
        for (const double value : values) {
            const double share = std::abs(value) / full;
            const double shown = share < 1 ? share : share >= 1 ? 1 : value;  // NaN stays
            plane.push_back(static_cast<float>(shown * (value > 0 ? vermilion : blue)[c]));
        }
    }
    return image;
}

}  // namespace wavepath
