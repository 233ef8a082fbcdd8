// What more samples do not take away, of synthetic pictures whose bias is known.
#include "measure/floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace wavepath {
namespace {

// Of expectation `mean` with noise of this deviation.
Image noisy_picture(double mean, double deviation, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, deviation);
    Image image;
    image.width = image.height = 64;
    for (const char* channel : {"R", "G", "B"})
        for (int i = 0; i < 64 * 64; ++i)
            image.channels[channel].push_back(static_cast<float>(mean + noise(random)));
    return image;
}

std::vector<Image> pictures_of(double mean, double deviation, unsigned count) {
    std::vector<Image> pictures;
    for (unsigned k = 0; k < count; ++k) pictures.push_back(noisy_picture(mean, deviation, 10 + k));
    return pictures;
}

// 5 % too dark under noise of 20 %, with references of 5 %: within 10 % of the squared bias. The
// standard error is .016 of it.
TEST(BiasFloor, IsTheSquaredBias) {
    const Image half1 = noisy_picture(1, 0.05, 1);
    const Image half2 = noisy_picture(1, 0.05, 2);
    const Interval floor = bias_floor(pictures_of(0.95, 0.2, 8), half1, half2);
    const double expected = 0.05 * 0.05 / 1.01;
    EXPECT_NEAR(floor.value, expected, 0.1 * expected);
    EXPECT_LT(floor.low, expected);
    EXPECT_GT(floor.high, expected);
}

// The interval of what is unbiased holds 0 in 95 of 100 cases.
TEST(BiasFloor, IsAboutZeroWithoutBias) {
    int outside = 0;
    for (unsigned k = 0; k < 40; ++k) {
        std::vector<Image> pictures;
        for (unsigned j = 0; j < 3; ++j)
            pictures.push_back(noisy_picture(1, 0.2, 1000 + 10 * k + j));
        const Interval floor = bias_floor(
            pictures, noisy_picture(1, 0.05, 5000 + 2 * k), noisy_picture(1, 0.05, 5001 + 2 * k));
        if (floor.low > 0 || floor.high < 0) ++outside;
    }
    EXPECT_LE(outside, 8);  // alpha: a binomial of 40 and .05 exceeds 8 with probability 1.3e-4
}

TEST(BiasFloor, TakesTwoPictures) {
    const Image half = noisy_picture(1, 0.05, 1);
    EXPECT_TRUE(std::isnan(bias_floor(pictures_of(1, 0.2, 1), half, half).value));
}

}  // namespace
}  // namespace wavepath
