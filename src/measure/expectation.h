// Whether two noisy pictures are of one expectation.
#pragma once

#include "image/image.h"

#include <optional>

namespace wavepath {

// The p-value of "A and B have one expectation in every pixel". It is below alpha with a
// probability of alpha where they have, and small where they have not and the samples suffice.
//
// It does not use the variance layers, which overstate the variance of Sobol points
// (docs/conventions.md), but that pixels are independent of one another. With the differences
// d = A - B of R, G, B and their sum, relative to the radiance around the pixel, over square tiles
// of 8, 16, ... pixels a side up to the whole picture, it looks at
//
//     t = sum d / sqrt(sum d^2)       the largest |t| of a size of tile, and the sum of t^2
//
// and asks how often a random sign for the d of each pixel gives more. `exchangeable`: A and B come
// from one program by one set of options, but for the seed. Then d is as likely as -d, and the
// p-value is exact for any noise. Otherwise it rests on sums over tiles being normal, so a size of
// tile counts only where the differences of a tile come from 32 pixels on average. Differences
// below 4e-6 of the radiance are rounding and count as none.
//
// Random signs go on until 100 gave more, or 9999 were tried [Besag & Clifford 1991]. Below 1e-4
// the value is the bound of [Hoeffding 1963], over all tiles. The same pictures give the same
// value. 1 where nothing differs; none where no pixel is finite in both, too few pixels differ, or
// too few carry the noise.
//
// A and B have to be comparable (measure/pixels.h); pixels that are not finite are left out.
std::optional<double> p_of_same_expectation(const Image& a, const Image& b, bool exchangeable);

}  // namespace wavepath
