#pragma once

#include "image/image.h"

namespace wavepath {

// The exposure [stops], to a hundredth, that makes the geometric mean of the luminance 0.18, middle
// grey [Reinhard 2002, eq. 1 and 2]. Over the pixels whose luminance is finite and above 0; 0 where
// there are none. Between -100 and 100.
double auto_exposure(const Image& image);

}  // namespace wavepath
