// The radiance of pictures, pixel by pixel: what every measure goes through.
#pragma once

#include "image/image.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace wavepath {

using Radiance = std::array<double, 3>;  // R, G, B

// Throws Error, with the pictures' names, unless both have one size and the channels R, G, B: every
// measure takes that for granted.
void check_comparable(
    const Image& a, const std::string& name_a, const Image& b, const std::string& name_b);

// Calls visit(index, radiance of each picture...) for the pixels that are finite in all pictures,
// row by row. Returns how many pixels were left out for not being so.
template <typename Visit, typename... Images>
std::size_t visit_finite_pixels(const Visit& visit, const Images&... images) {
    const auto pixels = [](const Image& image) {
        return [&r = image.channels.at("R"), &g = image.channels.at("G"),
                &b = image.channels.at("B")](std::size_t i) {
            return Radiance{r[i], g[i], b[i]};
        };
    };
    const auto finite = [](const Radiance& v) {
        return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
    };
    const auto visit_all = [&](const auto&... planes) {
        const std::array sizes{std::size_t{images.width} * images.height...};
        std::size_t left_out = 0;
        for (std::size_t i = 0; i < sizes[0]; ++i) {
            if ((finite(planes(i)) && ...))
                visit(i, planes(i)...);
            else
                ++left_out;
        }
        return left_out;
    };
    return visit_all(pixels(images)...);
}

}  // namespace wavepath
