#include "image/png_writer.h"

#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb_image.h>

namespace wavepath {
namespace {

using Texels = std::vector<uint8_t>;
using testing::HasSubstr;

Image grey_row(const std::vector<float>& values) {
    return {
        .width = static_cast<uint32_t>(values.size()),
        .height = 1,
        .channels = {{"R", values}, {"G", values}, {"B", values}},
        .metadata = {}};
}

Texels read_png(const std::filesystem::path& path, int expected_width, int expected_height) {
    int width = 0;
    int height = 0;
    int channels = 0;
    stbi_uc* data = stbi_load(path.c_str(), &width, &height, &channels, 0);
    EXPECT_NE(data, nullptr);
    EXPECT_EQ(width, expected_width);
    EXPECT_EQ(height, expected_height);
    EXPECT_EQ(channels, 3);
    Texels texels(data, data + 3 * std::ptrdiff_t{width} * height);
    stbi_image_free(data);
    return texels;
}

// The red channel of a row of grey values after a trip through a file.
Texels encoded(const std::vector<float>& values, double exposure) {
    const TemporaryFolder folder;
    write_png(grey_row(values), folder / "a.png", exposure);
    EXPECT_EQ(folder.file_count(), 1u);
    const Texels texels = read_png(folder / "a.png", static_cast<int>(values.size()), 1);
    Texels red;
    for (std::size_t i = 0; i < texels.size(); i += 3) red.push_back(texels[i]);
    return red;
}

TEST(PngWriter, EncodesSrgb) {
    // 255 x the transfer function: 0, 10.31 at the end of the linear part, 117.65, 187.52, 255;
    // clipped outside.
    EXPECT_EQ(
        encoded({0.0f, 0.0031308f, 0.18f, 0.5f, 1.0f, 1.5f, 3e38f, -0.5f, -0.0f}, 0.0),
        (Texels{0, 10, 118, 188, 255, 255, 255, 0, 0}));
}

TEST(PngWriter, RoundsToTheNearestCode) {
    for (const double offset : {-0.499, 0.0, 0.499}) {
        std::vector<float> linear;
        Texels codes;
        for (uint8_t code = 1; code < 255; ++code) {
            const double value = (code + offset) / 255.0;
            linear.push_back(static_cast<float>(
                value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4)));
            codes.push_back(code);
        }
        EXPECT_EQ(encoded(linear, 0.0), codes) << offset;
    }
}

TEST(PngWriter, ScalesByTwoToTheExposure) {
    EXPECT_EQ(encoded({0.25f, 0.5f}, 1.0), encoded({0.5f, 1.0f}, 0.0));
    EXPECT_EQ(encoded({1.0f, 8.0f}, -1.0), (Texels{188, 255}));
    EXPECT_EQ(encoded({0.125f}, 0.5), encoded({0.125f * std::sqrt(2.0f)}, 0.0));
}

TEST(PngWriter, ShowsNonFinitePixelsInMagenta) {
    const float infinity = std::numeric_limits<float>::infinity();
    Image image = grey_row({0.0f, 0.0f, 0.0f, 1.0f});
    image.channels["R"][0] = std::numeric_limits<float>::quiet_NaN();
    image.channels["G"][1] = infinity;
    image.channels["B"][2] = -infinity;
    const TemporaryFolder folder;
    write_png(image, folder / "a.png", 0.0);
    EXPECT_EQ(
        read_png(folder / "a.png", 4, 1),
        (Texels{255, 0, 255, 255, 0, 255, 255, 0, 255, 255, 255, 255}));
}

TEST(PngWriter, KeepsRowsAndChannelsInOrder) {
    const Image image{
        .width = 2,
        .height = 2,
        .channels =
            {{"R", {1, 0, 0, 0.5f}},
             {"G", {0, 1, 0, 0.5f}},
             {"B", {0, 0, 1, 0}},
             {"depth.Z", {9, 9, 9, 9}}},
        .metadata = {}};
    const TemporaryFolder folder;
    write_png(image, folder / "a.png", 0.0);
    EXPECT_EQ(
        read_png(folder / "a.png", 2, 2), (Texels{255, 0, 0, 0, 255, 0, 0, 0, 255, 188, 188, 0}));
}

TEST(PngWriter, NamesThePathItCannotWrite) {
    const TemporaryFolder folder;
    EXPECT_THAT(
        error_of([&] { write_png(grey_row({1.0f}), folder / "none/a.png", 0.0); }),
        HasSubstr("none/a.png: cannot be written: folder "));
    EXPECT_THAT(
        error_of([&] {
            write_png(
                {.width = 65536, .height = 65536, .channels = {}, .metadata = {}}, folder / "a.png",
                0.0);
        }),
        HasSubstr("a.png: 65536 x 65536 is too large for PNG; write .exr"));
    EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace wavepath
