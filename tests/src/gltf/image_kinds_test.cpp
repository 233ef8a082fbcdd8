// Images of every kind in files, in each of their patches, against what another decoder (Pillow 13)
// says.
#include "gltf/gltf_loader.h"
#include "support/case_files.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <array>

namespace wavepath {
namespace {

using testing::HasSubstr;

constexpr uint32_t width = 64;
constexpr uint32_t height = 48;

using Codes = std::array<int, 4>;
using Patches = std::array<Codes, 8>;

// The picture is one of two rows of four patches; JPEGs are within 1 code of it away from edges.
constexpr Patches in_colour{
    {{200, 40, 40, 255},
     {40, 200, 40, 255},
     {40, 40, 200, 255},
     {200, 200, 40, 255},
     {30, 30, 30, 255},
     {230, 230, 230, 255},
     {120, 60, 180, 255},
     {250, 140, 20, 255}}};

Patches in_grey(const std::array<int, 8>& codes) {
    Patches patches{};
    for (std::size_t k = 0; k < 8; ++k) patches[k] = {codes[k], codes[k], codes[k], 255};
    return patches;
}

Patches with_alphas(const std::array<int, 8>& alphas) {
    Patches patches = in_colour;
    for (std::size_t k = 0; k < 8; ++k) patches[k][3] = alphas[k];
    return patches;
}

class ImageKinds : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = case_folder("jpeg-zoo");
        if (folder_.empty()) GTEST_SKIP() << "no folder of cases beside the checkout";
    }

    TextureImage image_in(const std::string& name) const {
        return load_gltf(folder_ / (name + ".glb")).images.at(0);
    }

    // Within `codes` at four points of every patch.
    void expect_patches(const std::string& name, const Patches& patches, int codes) const {
        SCOPED_TRACE(name);
        const TextureImage image = image_in(name);
        ASSERT_EQ(image.width, width);
        ASSERT_EQ(image.height, height);
        ASSERT_FALSE(image.wide);
        for (uint32_t patch = 0; patch < 8; ++patch)
            for (const uint32_t x : {5U, 10U})
                for (const uint32_t y : {5U, 18U}) {
                    const uint32_t row = patch / 4 * 24 + y;
                    const uint32_t word = image.words[row * width + patch % 4 * 16 + x];
                    for (std::size_t c = 0; c < 4; ++c)
                        EXPECT_NEAR(static_cast<int>(word >> 8 * c & 255), patches[patch][c], codes)
                            << "patch " << patch << ", channel " << c;
                }
    }

    std::filesystem::path folder_;
};

// A wrong conversion (of inverted CMYK, of RGB taken for YCbCr, by an EXIF turn) is tens of codes
// off.
TEST_F(ImageKinds, OfJpegHaveTheColoursOfAnotherDecoder) {
    for (const char* name :
         {"plain", "s420", "s422", "s444", "progressive", "restart", "no_jfif", "adobe_ycc",
          "rgb_ids", "rgb_adobe0", "exif_turned", "exif_no_jfif", "cmyk", "icc", "trailing",
          "comment", "optimize", "jpeg_as_png"})
        expect_patches(name, in_colour, 2);
    expect_patches("grey", in_grey({88, 134, 58, 182, 30, 230, 92, 159}), 2);
}

TEST_F(ImageKinds, OfPngHaveTheirCodes) {
    expect_patches("png_as_jpeg", in_colour, 0);
    expect_patches("png_palette", in_colour, 0);
    expect_patches("png_la", in_grey({88, 134, 58, 182, 30, 230, 92, 159}), 0);
    expect_patches("png_palette_trns", with_alphas({255, 0, 255, 128, 255, 255, 64, 255}), 0);
}

// Dithered: of black and white alone, 120.776 on average.
TEST_F(ImageKinds, OfOneBitAreBlackAndWhite) {
    const TextureImage image = image_in("png_1bit");
    double sum = 0;
    for (const uint32_t word : image.words) {
        ASSERT_TRUE(word == 0xFFFFFFFF || word == 0xFF000000) << word;
        sum += word & 255;
    }
    EXPECT_NEAR(sum / (width * height), 120.776, 1e-3);
}

// A ramp from 0 to 65535.
TEST_F(ImageKinds, Of16BitsKeepThem) {
    const TextureImage image = image_in("png_grey16");
    ASSERT_TRUE(image.wide);
    constexpr uint32_t texels = width * height;
    for (uint32_t i = 0; i < texels; ++i) {
        const uint32_t code = i * 65535 / (texels - 1);
        ASSERT_EQ(image.words[2 * i], code * 0x10001U) << i;
        ASSERT_EQ(image.words[2 * i + 1], code | 0xFFFF0000U) << i;
    }
}

// A picture that ends too soon may lack its lower half: it is not rendered with grey in its place.
TEST_F(ImageKinds, ThatAreCutShortAreRefusedByName) {
    for (const char* name : {"no_eoi", "cut_one_byte"})
        EXPECT_THAT(
            error_of([&] { image_in(name); }),
            testing::AllOf(HasSubstr(name), HasSubstr("image 0")));
}

}  // namespace
}  // namespace wavepath
