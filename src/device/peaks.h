// What a device can do at most: the two sides of the roofline [Williams 2009].
#pragma once

#include "device/device.h"

#include <algorithm>

namespace wavepath {

struct Peaks {
    double bytes_per_s = 0;  // of a triad over more than the caches hold
    double flops_per_s = 0;  // of fused multiply-adds, two operations each
    int vector_width = 1;    // at which these were most

    // The most that a kernel of so many operations a byte can do [1/s].
    double roof(double flops_per_byte) const {
        return std::min(flops_per_s, flops_per_byte * bytes_per_s);
    }
};

// Runs kernels/peaks for about a second, by the host's clock: the best of several goes, so that
// other work on the machine counts little.
Peaks measure_peaks(const Device& device);

}  // namespace wavepath
