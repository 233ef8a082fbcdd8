// Where pictures differ, as pictures. A and B have to be comparable (measure/pixels.h).
#pragma once

#include "image/image.h"

#include <optional>
#include <vector>

namespace wavepath {

// (A - B) / (mean of A and B in the pixel + 0.1), of the mean over channels [1]; NaN where one is
// not finite.
std::vector<double> relative_differences(const Image& a, const Image& b);

// (A - B) / sqrt(variance of A + variance of B), of the mean over channels, whose variances are
// added as those of fully dependent channels; 0 where nothing differs, NaN where one is not finite.
// Conservative: variance layers overstate the variance of Sobol points (docs/conventions.md), so
// that z spreads by less than 1. None where a picture has no variance layers.
std::optional<std::vector<double>> z_scores(const Image& a, const Image& b);

// Values of pixels as R, G, B in [0, 1]: from black at 0 to vermilion at `full` and more, to blue
// at -full and less; NaN stays.
Image signed_picture(
    uint32_t width, uint32_t height, const std::vector<double>& values, double full);

}  // namespace wavepath
