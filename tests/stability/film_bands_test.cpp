// A film larger than one buffer of the device is the film of one buffer.
#include "shared/film.h"
#include "support/rendering.h"

#include <gmock/gmock.h>

#include <cstring>
#include <utility>

namespace wavepath {
namespace {

Scene lit_room() {
    Scene scene = scene_named("room");
    add_box(scene, lambert({0.7F, 0.5F, 0.4F}), {-1, -1, -1}, {1, 1, 1}, Facing::inward);
    add_square(scene, lambert(grey(0), grey(6)), {0, 0.9, 0}, {0, -1, 0}, 0.8);
    return scene;
}

Device with_buffers_of(std::size_t bytes) {
    Device device = test_device();
    device.info.max_allocation = bytes;
    return device;
}

// 2077 pixels in bands of 1470 and 441, which end within a row.
TEST(FilmBands, SameBytesWhateverOneBufferHolds) {
    RenderSettings settings =
        square_settings("mis", perspective({0.8, 0.2, 0.9}, {-0.2, -0.4, -0.3}, 1.2), 67, 24);
    settings.height = 31;
    settings.pool = 256;
    const RenderResult one = render(test_device(), lit_room(), settings);
    for (const std::size_t bytes : {200000U, 60000U}) {
        SCOPED_TRACE(bytes);
        ASSERT_GT(one.film_bytes, bytes);
        const RenderResult bands = render(with_buffers_of(bytes), lit_room(), settings);
        for (const auto& [name, plane] : one.film.image.channels) {
            const std::vector<float>& other = bands.film.image.channels.at(name);
            ASSERT_EQ(plane.size(), other.size()) << name;
            EXPECT_EQ(std::memcmp(plane.data(), other.data(), plane.size() * sizeof(float)), 0)
                << name;
        }
        EXPECT_EQ(one.film.relative_error, bands.film.relative_error);
        EXPECT_EQ(one.film_bytes, bands.film_bytes);
    }
}

TEST(FilmBands, OfAFilmCoverEveryPixelOnce) {
    const Film film(with_buffers_of(FILM_PLANES * 4 * 10), 7, 9, 1000);
    ASSERT_EQ(film.bands.size(), 7U);
    for (uint32_t pixel = 0; pixel < 63; ++pixel) {
        const FilmBand& band = film.band_of(pixel);
        EXPECT_GE(pixel, band.first_pixel);
        EXPECT_LT(pixel, band.first_pixel + band.pixels);
    }
    EXPECT_EQ(film.bands.back().pixels, 3U);
    EXPECT_EQ(film.bytes(), 63 * Film::pixel_bytes);
    EXPECT_EQ(Film(test_device(), 7, 9, 8).bands.size(), 8U);
}

TEST(FilmBands, NameTheFirstNonFinitePixelOfThePicture) {
    const Device device = with_buffers_of(sizeof(cl_float) * FILM_PLANES * 16);
    Film film(device, 8, 8, 1000);
    ASSERT_EQ(film.bands.size(), 4U);
    const cl_uint found[] = {3, 17};  // samples that were not finite, the first of them
    const FilmBand& band = film.bands[1];
    for (std::size_t flag = 0; flag < FILM_FLAGS; ++flag)
        device.queue.enqueueWriteBuffer(
            band.flags.buffer(), CL_TRUE, sizeof(cl_uint) * (flag * band.pixels + 5),
            sizeof(cl_uint), &found[flag]);
    const NonFinite nonfinite = develop(device, std::move(film), 1, 1).nonfinite;
    EXPECT_EQ(nonfinite.samples, 3U);
    EXPECT_EQ(nonfinite.x, 5U);
    EXPECT_EQ(nonfinite.y, 2U);
    EXPECT_EQ(nonfinite.sample, 17U);
}

TEST(FilmBands, RefusesAFilmBeyondTheMemoryBeforeItIsMade) {
    RenderSettings settings = square_settings("mis", perspective({0, 0, 0.9}, {0, 0, 0}, 1), 4, 1);
    settings.width = settings.height = 1U << 15U;
    settings.pool = 256;
    Device device = test_device();
    device.info.global_memory = uint64_t{1} << 30U;
    try {
        render(device, lit_room(), settings);
        FAIL() << "2^30 pixels in 1 GiB";
    } catch (const Error& error) {
        EXPECT_THAT(
            error.what(), testing::HasSubstr("147456 for the film, 144 bytes a pixel; there are"));
    }
}

}  // namespace
}  // namespace wavepath
