#include "film/outlier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wavepath {
namespace {

// Ten by ten pixels of radiance 1, each known to a standard error of .1.
Image even_picture() {
    Image image;
    image.width = 10;
    image.height = 10;
    for (const char* channel : {"R", "G", "B"}) {
        image.channels[channel].assign(100, 1);
        image.channels[std::string("variance.") + channel].assign(100, 0.01F);
    }
    return image;
}

void set_pixel(Image& image, std::size_t pixel, float mean, float error) {
    for (const char* channel : {"R", "G", "B"}) {
        image.channels[channel][pixel] = mean;
        image.channels[std::string("variance.") + channel][pixel] = error * error;
    }
}

TEST(Outlier, IsNothingInAnEvenPicture) {
    EXPECT_EQ(largest_outlier(even_picture()).share, 0);
}

TEST(Outlier, IsThePixelWhoseErrorIsTheLargest) {
    Image image = even_picture();
    set_pixel(image, 42, 100, 100);
    set_pixel(image, 7, 2, 1);
    const Outlier outlier = largest_outlier(image);
    EXPECT_FLOAT_EQ(static_cast<float>(outlier.share), 0.5F);  // 100 of 98 + 100 + 2
    EXPECT_EQ(outlier.x, 2U);
    EXPECT_EQ(outlier.y, 4U);
}

TEST(Outlier, IsNoBrightPixelThatIsSettled) {
    Image image = even_picture();
    set_pixel(image, 42, 1000, 300);
    EXPECT_EQ(largest_outlier(image).share, 0);
}

TEST(Outlier, OfAVarianceBeyondFloatsIsThePixel) {
    Image image = even_picture();
    set_pixel(image, 3, 1e20F, 0);
    for (const char* channel : {"R", "G", "B"})
        image.channels[std::string("variance.") + channel][3] =
            std::numeric_limits<float>::infinity();
    set_pixel(image, 5, NAN, NAN);
    EXPECT_NEAR(largest_outlier(image).share, 1, 1e-6);
}

TEST(Outlier, IsWarnedOfWhereItMakesATenth) {
    const double many = 1e6;
    EXPECT_FALSE(outlier_warning({0.09, 1, 2}, many, false));
    EXPECT_THAT(
        outlier_warning({0.11, 1, 2}, many, false).value_or(""),
        testing::HasSubstr("pixel (1, 2) make 11 % of the picture's mean"));
    EXPECT_THAT(
        outlier_warning({0.11, 1, 2}, many, true).value_or(""), testing::HasSubstr("conserving"));
    EXPECT_FALSE(outlier_warning({0.15, 1, 2}, 16384, false)) << "20 / sqrt(16384) is .156";
    EXPECT_TRUE(outlier_warning({0.16, 1, 2}, 16384, false));
    EXPECT_FALSE(outlier_warning({0.9, 1, 2}, 4096, false)) << "too few samples to tell";
}

}  // namespace
}  // namespace wavepath
