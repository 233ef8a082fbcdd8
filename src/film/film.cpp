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

std::vector<FilmBand> bands_of(const Device& device, std::size_t pixels, std::size_t most_pixels) {
    const std::size_t most = std::clamp<std::size_t>(
        device.info.max_allocation / (FILM_PLANES * sizeof(cl_float)), 1, most_pixels);
    std::vector<FilmBand> bands;
    for (std::size_t first = 0; first < pixels; first += most) {
        const std::size_t count = std::min(most, pixels - first);
        bands.push_back(
            {static_cast<uint32_t>(first), static_cast<uint32_t>(count),
             zeros<cl_float>(device, FILM_PLANES * count),
             zeros<cl_uint>(device, FILM_FLAGS * count)});
    }
    return bands;
}

// A band as the host reads it.
class BandView {
  public:
    BandView(const Device& device, const FilmBand& band, uint64_t samples, uint32_t batches)
        : pixels_(band.pixels),
          planes_(band.planes.map(device)),
          flags_(band.flags.map(device)),
          samples_(static_cast<double>(samples)),
          batches_(batches) {}

    std::size_t pixels() const { return pixels_; }
    cl_uint flag(std::size_t flag, std::size_t i) const { return flags_[flag * pixels_ + i]; }
    double total(std::size_t plane, std::size_t i) const {
        return double{planes_[(FILM_SUM + plane) * pixels_ + i]} -
               planes_[(FILM_LOST + plane) * pixels_ + i];
    }
    double mean(std::size_t plane, std::size_t i) const { return total(plane, i) / samples_; }
    double depth(std::size_t i) const {
        const double hits = total(SUM_COVERAGE - SUM_R, i);
        return hits > 0 ? total(SUM_DEPTH - SUM_R, i) / hits : 0;
    }
    // Of the mean of a colour channel; NaN below 2 batches.
    double variance(std::size_t c, std::size_t i) const {
        if (batches_ < 2) return std::numeric_limits<double>::quiet_NaN();
        const double deviation = planes_[(FILM_DEVIATION + c) * pixels_ + i];
        return deviation / (samples_ * (batches_ - 1));
    }

  private:
    std::size_t pixels_;
    MappedArray<cl_float> planes_;
    MappedArray<cl_uint> flags_;
    double samples_;
    uint32_t batches_;
};

// Appends the band's pixels to the channels.
void develop_band(const BandView& band, bool has_variance, Image& image) {
    const auto append = [&](const char* name, const auto& value) {
        std::vector<float>& channel = image.channels.at(name);
        for (std::size_t i = 0; i < band.pixels(); ++i)
            channel.push_back(static_cast<float>(value(i)));
    };
    for (std::size_t plane = 0; plane + 1 < SUM_PLANES; ++plane)
        append(sum_channels[plane], [&](std::size_t i) {
            return plane == SUM_DEPTH - SUM_R ? band.depth(i) : band.mean(plane, i);
        });
    for (std::size_t c = 0; c < 3; ++c)
        append(variance_channels[c], [&](std::size_t i) {
            return has_variance ? band.variance(c, i) : 0;
        });
}

void count_nonfinite(const BandView& band, const FilmBand& place, uint32_t width, NonFinite& sum) {
    for (std::size_t i = 0; i < band.pixels(); ++i) {
        const cl_uint found = band.flag(FILM_NONFINITE, i);
        if (found == 0) continue;
        if (sum.samples == 0) {
            const auto pixel = static_cast<uint32_t>(place.first_pixel + i);
            sum = {0, pixel % width, pixel / width, band.flag(FILM_FIRST_NONFINITE, i)};
        }
        sum.samples += found;
        for (std::size_t c = 0; c < 3; ++c)
            if ((std::bit_cast<uint32_t>(static_cast<float>(band.mean(c, i))) & 0x7fffffffU) ==
                NAN_OF_MEDIA)
                sum.of_media = true;
    }
}

}  // namespace

const std::size_t Film::pixel_bytes = FILM_PLANES * sizeof(cl_float) + FILM_FLAGS * sizeof(cl_uint);

Film::Film(const Device& device, uint32_t w, uint32_t h, uint64_t most_pixels)
    : width(w), height(h), bands(bands_of(device, std::size_t{w} * h, most_pixels)) {}

double relative_error(const Device& device, const Film& film, uint64_t samples, uint32_t batches) {
    double error = 0;
    std::size_t counted = 0;
    for (const FilmBand& part : film.bands) {
        const BandView band(device, part, samples, batches);
        // pixel by pixel, so that the sum does not depend on the bands
        for (std::size_t i = 0; i < band.pixels(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const double mean = band.mean(c, i);
                if (!std::isfinite(mean)) continue;
                error += band.variance(c, i) / (mean * mean + 0.01);
                ++counted;
            }
    }
    return std::sqrt(error / static_cast<double>(counted));
}

DevelopedFilm develop(const Device& device, Film film, uint64_t samples, uint32_t batches) {
    DevelopedFilm out;
    out.relative_error = relative_error(device, film, samples, batches);
    out.image.width = film.width;
    out.image.height = film.height;
    const std::size_t pixels = std::size_t{film.width} * film.height;
    for (const char* name : sum_channels) out.image.channels[name].reserve(pixels);
    for (const char* name : variance_channels) out.image.channels[name].reserve(pixels);
    for (FilmBand& part : film.bands) {
        {
            const BandView band(device, part, samples, batches);
            develop_band(band, batches > 1, out.image);
            count_nonfinite(band, part, film.width, out.nonfinite);
        }
        part = {};
    }
    return out;
}

}  // namespace wavepath
