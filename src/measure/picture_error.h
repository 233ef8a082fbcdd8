// How far pictures are from one another, by R, G and B. All pictures of a call have to be
// comparable (measure/pixels.h). A pixel that is not finite in one of them is left out and counted.
#pragma once

#include "image/image.h"

#include <cstddef>
#include <vector>

namespace wavepath {

struct PictureError {
    double value = 0;          // NaN where no pixel is left
    std::size_t left_out = 0;  // pixels that are not finite
};

// Mean of (A - R)^2 over pixels and channels [radiance^2]. The reference's own error is in it.
PictureError mse(const Image& a, const Image& reference);

// Mean of (A - R)^2 / (R^2 + 0.01) over pixels and channels [1], as in docs/conventions.md. The
// reference's own error is in it.
PictureError rel_mse(const Image& a, const Image& reference);

// The same measures by a reference of two independent halves: (A - R1)(A - R2) in place of
// (A - R)^2, whose expected value lacks the halves' noise, so that a noisy reference adds no floor.
// R = (R1 + R2) / 2 in the denominator of relMSE. By chance the value can be negative where A is as
// good as the reference.
PictureError mse(const Image& a, const Image& half1, const Image& half2);
PictureError rel_mse(const Image& a, const Image& half1, const Image& half2);

// How good the reference R = (R1 + R2) / 2 itself is: relMSE of R against the truth, estimated by
// the mean of ((R1 - R2) / 2)^2 / (R^2 + 0.01).
PictureError rel_mse_of_halves(const Image& half1, const Image& half2);

struct Ratio {
    double value = 0;           // NaN where B is black
    double standard_error = 0;  // of value
    std::size_t left_out = 0;   // pixels that are not finite
};

// Mean of A over mean of B, both over pixels and channels. The standard error is that of a ratio
// estimator [Cochran 1977], from the scatter of A - value B over pixels, which are
// independent. It holds where A and B differ by noise and one factor, and is too large where they
// differ otherwise.
Ratio ratio_of_means(const Image& a, const Image& b);

// Unbiased variance of R, G and B over K >= 2 independent pictures of one expectation, pixel by
// pixel [radiance^2]; NaN where one is not finite.
Image variance_over(const std::vector<Image>& pictures);

// (A - R) / sqrt(R^2 + 0.01) of every finite pixel and channel [1]: what rel_mse squares.
std::vector<double> relative_deviations(const Image& a, const Image& reference);

}  // namespace wavepath
