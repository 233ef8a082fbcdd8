#include "film/film.h"

#include "shared/film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace wavepath {

namespace {

// Zeroed once a render, by writes and not by a fill: oclgrind 21.10 takes what a fill wrote for
// uninitialised.
template <typename T>
DeviceArray<T> zeros(const Device& device, std::size_t count) {
    DeviceArray<T> array(device, count, "film");
    const std::vector<T> block(
        std::min(count, std::size_t{1} << 18U));  // no second film on the host
    for (std::size_t begin = 0; begin < count; begin += block.size())
        device.queue.enqueueWriteBuffer(
            array.buffer(), CL_TRUE, sizeof(T) * begin,
            sizeof(T) * std::min(block.size(), count - begin), block.data());
    return array;
}

constexpr const char* sum_channels[SUM_PLANES - 1] = {
    "R",        "G",        "B",        "albedo.R", "albedo.G",
    "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"};
constexpr const char* variance_channels[3] = {"variance.R", "variance.G", "variance.B"};

}  // namespace

Film::Film(const Device& device, uint32_t w, uint32_t h)
    : width(w),
      height(h),
      planes(zeros<cl_float>(device, std::size_t{FILM_PLANES} * w * h)),
      flags(zeros<cl_uint>(device, std::size_t{FILM_FLAGS} * w * h)) {}

DevelopedFilm develop(const Device& device, const Film& film, uint64_t samples, uint32_t batches) {
    const std::size_t pixels = std::size_t{film.width} * film.height;
    const std::vector<cl_float> planes = film.planes.read(device);
    const std::vector<cl_uint> flags = film.flags.read(device);
    const auto total = [&](std::size_t plane, std::size_t i) {
        return double{planes[(FILM_SUM + plane) * pixels + i]} -
               planes[(FILM_LOST + plane) * pixels + i];
    };
    const auto n = static_cast<double>(samples);

    DevelopedFilm out;
    out.image.width = film.width;
    out.image.height = film.height;
    for (std::size_t plane = 0; plane + 1 < SUM_PLANES; ++plane) {
        std::vector<float>& channel = out.image.channels[sum_channels[plane]];
        channel.resize(pixels);
        for (std::size_t i = 0; i < pixels; ++i)
            channel[i] = static_cast<float>(total(plane, i) / n);
    }
    std::vector<float>& depth = out.image.channels["depth.Z"];
    for (std::size_t i = 0; i < pixels; ++i) {
        const double hits = total(SUM_COVERAGE - SUM_R, i);
        depth[i] = hits > 0 ? static_cast<float>(total(SUM_DEPTH - SUM_R, i) / hits) : 0;
    }

    double error = 0;
    std::size_t counted = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& channel = out.image.channels[variance_channels[c]];
        channel.resize(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            const double deviation = planes[(FILM_DEVIATION + c) * pixels + i];
            const double variance = batches > 1 ? deviation / (n * (batches - 1))
                                                : std::numeric_limits<double>::quiet_NaN();
            channel[i] = batches > 1 ? static_cast<float>(variance) : 0;
            const double mean = total(c, i) / n;
            if (!std::isfinite(mean)) continue;
            error += variance / (mean * mean + 0.01);
            ++counted;
        }
    }
    out.relative_error = std::sqrt(error / static_cast<double>(counted));

    for (std::size_t i = 0; i < pixels; ++i) {
        const cl_uint found = flags[FILM_NONFINITE * pixels + i];
        if (found == 0) continue;
        if (out.nonfinite.samples == 0) {
            out.nonfinite.x = static_cast<uint32_t>(i % film.width);
            out.nonfinite.y = static_cast<uint32_t>(i / film.width);
            out.nonfinite.sample = flags[FILM_FIRST_NONFINITE * pixels + i];
        }
        out.nonfinite.samples += found;
        for (const char* channel : {"R", "G", "B"})
            if ((std::bit_cast<uint32_t>(out.image.channels[channel][i]) & 0x7fffffffU) ==
                NAN_OF_MEDIA)
                out.nonfinite.of_media = true;
    }
    return out;
}

}  // namespace wavepath
