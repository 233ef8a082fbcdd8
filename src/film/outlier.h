// A mean that a few samples make, whatever brought them.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <optional>
#include <string>

namespace wavepath {

// What a few samples of one pixel make of the picture's mean [1].
struct Outlier {
    double share = 0;
    uint32_t x = 0, y = 0;
};

// The largest, by the layers R, G, B and their variance: a sample of value c among N of a pixel
// sets the standard error of the pixel's mean to about c / N, however the samples were cut into
// batches. Pixels whose error is below a third of their mean are bright by themselves, as the edge
// of a lamp is, and do not count, nor do pixels that are not finite. 0 where there is no variance.
Outlier largest_outlier(const Image& image);

// A warning if the mean rests on the outlier: if that makes a tenth of it. Nothing is said of
// pictures of few `samples` (of all pixels together), where that is no wonder: the largest of N
// samples of a tail that just has a variance grows as sqrt(N).
// `gains_energy`: materials of the scene do, as the specification has it.
std::optional<std::string> outlier_warning(
    const Outlier& outlier, double samples, bool gains_energy);

}  // namespace wavepath
