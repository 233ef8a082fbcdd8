#include "measure/floor.h"

#include <array>
#include <cmath>
#include <limits>

namespace wavepath {

Interval bias_floor(const std::vector<Image>& pictures, const Image& half1, const Image& half2) {
    const auto count = static_cast<double>(pictures.size());
    if (pictures.size() < 2) {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        return {nan, nan, nan};
    }
    std::vector<double> of_pixels;
    const std::size_t pixels = std::size_t{half1.width} * half1.height;
    of_pixels.reserve(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        double sum = 0;
        for (const char* channel : {"R", "G", "B"}) {
            const double r1 = half1.channels.at(channel)[i];
            const double r2 = half2.channels.at(channel)[i];
            double first = 0;
            double second = 0;
            double same = 0;  // the pairs i = j of the product of sums
            for (const Image& picture : pictures) {
                const double a = picture.channels.at(channel)[i];
                first += a - r1;
                second += a - r2;
                same += (a - r1) * (a - r2);
            }
            const double r = 0.5 * (r1 + r2);
            sum += (first * second - same) / (count * (count - 1)) / (r * r + 0.01) / 3;
        }
        if (std::isfinite(sum)) of_pixels.push_back(sum);
    }
    return mean_interval(of_pixels);
}

}  // namespace wavepath
