// What more samples do not take away.
#pragma once

#include "image/image.h"
#include "measure/interval.h"

#include <vector>

namespace wavepath {

// relMSE of the expectation of K >= 2 independent pictures A_k against the truth: its squared bias,
//
//     mean over pixels and channels of (A_i - R1)(A_j - R2) / (R^2 + 0.01),   i != j,
//
// averaged over all pairs i, j. Neither the noise of the pictures nor that of the two halves of the
// reference R = (R1 + R2) / 2 is in its expected value, so that it is about 0, of either sign, for
// what is unbiased. The interval is that of the mean over pixels, which are independent but where
// they share their bias: a bias that is alike in all pixels leaves it narrow. All is NaN for one
// picture. Pictures have to be comparable (measure/pixels.h).
Interval bias_floor(const std::vector<Image>& pictures, const Image& half1, const Image& half2);

}  // namespace wavepath
