#include "film/auto_exposure.h"

#include <algorithm>
#include <cmath>

namespace wavepath {

double auto_exposure(const Image& image) {
    const std::vector<float>& r = image.channels.at("R");
    const std::vector<float>& g = image.channels.at("G");
    const std::vector<float>& b = image.channels.at("B");
    double sum = 0;  // of log2(luminance)
    std::size_t counted = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
        const double luminance =  // of Rec. 709 primaries
            0.2126 * double{r[i]} + 0.7152 * double{g[i]} + 0.0722 * double{b[i]};
        if (!std::isfinite(luminance) || luminance <= 0) continue;
        sum += std::log2(luminance);
        ++counted;
    }
    if (counted == 0) return 0;
    const double stops = std::log2(0.18) - sum / static_cast<double>(counted);
    return std::clamp(std::round(100 * stops) / 100, -100.0, 100.0);
}

}  // namespace wavepath
