// Pictures of known expectation and variance, for tests of measures.
#pragma once

#include "image/image.h"

#include <cmath>
#include <cstdint>
#include <random>

namespace wavepath {

// Every channel of every pixel is this.
inline Image even_picture(uint32_t width, uint32_t height, float radiance) {
    Image image{.width = width, .height = height, .channels = {}, .metadata = {}};
    for (const char* channel : {"R", "G", "B"})
        image.channels[channel].assign(std::size_t{width} * height, radiance);
    return image;
}

// A scene of sorts: radiance from 0.1 to 1.1 by columns, a lamp of radiance 20 in the middle.
inline Image lamp_picture(uint32_t size) {
    Image image = even_picture(size, size, 0);
    for (auto& [name, plane] : image.channels)
        for (uint32_t y = 0; y < size; ++y)
            for (uint32_t x = 0; x < size; ++x) {
                const bool lamp = 8 * x / size == 4 && 8 * y / size == 4;
                plane[std::size_t{y} * size + x] =
                    lamp ? 20.0F : 0.1F + static_cast<float>(x) / static_cast<float>(size);
            }
    return image;
}

// Gamma noise: each pixel has the expectation of `truth` and the standard deviation `noise` times
// that, by a law of skewness 2 * noise. The channels of a pixel share half of their noise.
inline Image noisy_picture(const Image& truth, double noise, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::gamma_distribution<double> gamma(1 / (noise * noise), noise * noise);
    Image image = truth;
    for (std::size_t i = 0; i < std::size_t{truth.width} * truth.height; ++i) {
        const double shared = gamma(random);
        for (const char* channel : {"R", "G", "B"}) {
            const double own = gamma(random);
            image.channels[channel][i] *=
                static_cast<float>(1 + ((shared - 1) + (own - 1)) / std::sqrt(2));
        }
    }
    return image;
}

}  // namespace wavepath
