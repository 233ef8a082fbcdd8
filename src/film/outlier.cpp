#include "film/outlier.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace wavepath {

Outlier largest_outlier(const Image& image) {
    constexpr double settled = 1.0 / 3;
    Outlier largest;
    double sum = 0;
    double most = 0;
    std::array<std::pair<const float*, const float*>, 3> channels;  // and their variances
    for (std::size_t c = 0; c < 3; ++c) {
        const std::string name(1, "RGB"[c]);
        channels[c] = {
            image.channels.at(name).data(), image.channels.at("variance." + name).data()};
    }
    for (std::size_t i = 0; i < std::size_t{image.width} * image.height; ++i) {
        double mean = 0;
        double error = 0;
        for (const auto& [radiance, variance] : channels) {
            mean += radiance[i];
            error += std::sqrt(variance[i]);
        }
        if (!std::isfinite(mean)) continue;
        if (!std::isfinite(error)) error = mean;  // the square of a sample is beyond floats
        sum += mean;
        if (error <= most || error <= settled * mean) continue;
        most = error;
        largest.x = static_cast<uint32_t>(i % image.width);
        largest.y = static_cast<uint32_t>(i / image.width);
    }
    largest.share = sum > 0 ? most / sum : 0;
    return largest;
}

std::optional<std::string> outlier_warning(
    const Outlier& outlier, double samples, bool gains_energy) {
    constexpr double least_samples = 1 << 13U;
    constexpr double bound = 0.1;
    if (samples < least_samples || outlier.share < std::max(bound, 20 / std::sqrt(samples)))
        return std::nullopt;
    return fmt::format(
        "a few samples of pixel ({}, {}) make {:.0f} % of the picture's mean, which is not "
        "settled; {}",
        outlier.x, outlier.y, 100 * outlier.share,
        gains_energy ? "by --layering specification dielectrics gain energy: use conserving"
                     : "take more, or find out what light they bring");
}

}  // namespace wavepath
