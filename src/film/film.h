// The image under way, on the device.
#pragma once

#include "device/device_array.h"
#include "image/image.h"

#include <cstdint>
#include <vector>

namespace wavepath {

// A range of pixels, in buffers of its own: those of a window of the render.
// NOLINTNEXTLINE(bugprone-exception-escape): see Device
struct FilmBand {
    uint32_t first_pixel = 0, pixels = 0;
    DeviceArray<cl_float> planes;  // FILM_PLANES a pixel
    DeviceArray<cl_uint> flags;    // FILM_FLAGS a pixel
};

// In bands, so that no picture is larger than what the device allows in one buffer, and that each
// is given back as soon as it is developed. A pixel belongs to one band.
// NOLINTNEXTLINE(bugprone-exception-escape): see Device
struct Film {
    static const std::size_t pixel_bytes;

    // A band has at most `most_pixels`, and fewer where the device allows less in one buffer.
    Film(const Device& device, uint32_t width, uint32_t height, uint64_t most_pixels);

    uint32_t width, height;
    std::vector<FilmBand> bands;  // in the order of pixels, all of one size but the last

    const FilmBand& band_of(uint32_t pixel) const { return bands[pixel / bands.front().pixels]; }
    std::size_t bytes() const { return pixel_bytes * width * height; }
};

struct NonFinite {
    uint64_t samples = 0;
    uint32_t x = 0, y = 0, sample = 0;  // the first, in pixel order
    bool of_media = false;              // some for more media than a path can follow
};

struct DevelopedFilm {
    Image image;  // all layers; metadata is the caller's
    NonFinite nonfinite;
    double relative_error = 0;  // NaN below 2 batches
};

// sqrt(mean(variance / (mean^2 + 0.01))) over pixels and channels, as develop() would find it.
double relative_error(const Device& device, const Film& film, uint64_t samples, uint32_t batches);

// Means, and the variance of the mean over `batches` batches: W M / (B - 1) with W the samples.
// Pixels that hold a non-finite sample stay non-finite and are left out of relative_error. Depth is
// 0 where nothing was hit. Uses the film up: the picture grows as its bands go.
DevelopedFilm develop(const Device& device, Film film, uint64_t samples, uint32_t batches);

}  // namespace wavepath
