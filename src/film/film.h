// The image under way, on the device.
#pragma once

#include "device/device_array.h"
#include "film/image.h"

#include <cstdint>

namespace wavepath {

struct Film {
    Film(const Device& device, uint32_t width, uint32_t height);

    uint32_t width, height;
    DeviceArray<cl_float> planes;  // FILM_PLANES a pixel
    DeviceArray<cl_uint> flags;    // FILM_FLAGS a pixel

    std::size_t bytes() const { return planes.bytes() + flags.bytes(); }
};

struct NonFinite {
    uint64_t samples = 0;
    uint32_t x = 0, y = 0, sample = 0;  // the first, in pixel order
    bool of_media = false;              // some for more media than a path can follow
};

struct DevelopedFilm {
    Image image;  // all layers; metadata is the caller's
    NonFinite nonfinite;
    double relative_error =
        0;  // sqrt(mean(variance / (mean^2 + 0.01))) over pixels and channels; NaN below 2 batches
};

// Means, and the variance of the mean over `batches` batches: W M / (B - 1) with W the samples.
// Pixels that hold a non-finite sample stay non-finite and are left out of relative_error. Depth is
// 0 where nothing was hit.
DevelopedFilm develop(const Device& device, const Film& film, uint64_t samples, uint32_t batches);

}  // namespace wavepath
