#include "image/png_writer.h"

#include "error.h"
#include "image/atomic_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC  // libtinygltf brings another copy
#define STBI_WRITE_NO_STDIO     // files are AtomicFile's
#include <stb_image_write.h>

namespace wavepath {
namespace {

constexpr std::array<uint8_t, 3> magenta{255, 0, 255};

// The transfer function of sRGB, 8 bits [IEC 61966-2-1].
uint8_t encode_srgb(double linear) {
    if (!(linear > 0.0)) return 0;  // NaN too
    if (linear >= 1.0) return 255;
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::lround(255.0 * encoded));
}

}  // namespace

void write_png(const Image& image, const std::filesystem::path& path, double exposure) {
    AtomicFile file(path);
    const std::size_t pixels = std::size_t{image.width} * image.height;
    // stb_image_write counts bytes in int, and doubles its buffer of up to 3 a pixel.
    if (pixels > std::size_t{1} << 28U) {
        throw Error(
            "{}: {} x {} is too large for PNG; write .exr", path.string(), image.width,
            image.height);
    }
    const double scale = std::exp2(exposure);
    const std::array planes{
        &image.channels.at("R"), &image.channels.at("G"), &image.channels.at("B")};
    std::vector<uint8_t> texels(3 * pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        bool finite = true;
        for (std::size_t c = 0; c < 3; ++c) {
            const float radiance = (*planes[c])[pixel];
            finite = finite && std::isfinite(radiance);
            texels[3 * pixel + c] = encode_srgb(scale * static_cast<double>(radiance));
        }
        if (!finite) std::copy(magenta.begin(), magenta.end(), &texels[3 * pixel]);
    }

    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(
            static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    const int width = static_cast<int>(image.width);
    if (!stbi_write_png_to_func(
            append, &bytes, width, static_cast<int>(image.height), 3, texels.data(), 3 * width)) {
        throw Error("{}: not enough memory to write PNG; write .exr", path.string());
    }
    file.commit(bytes);
}

}  // namespace wavepath
