#include "measure/expectation.h"

#include "support/noisy_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wavepath {
namespace {

// Kolmogorov's largest distance of p-values from the uniform law.
double distance_from_uniform(std::vector<double> values) {
    std::ranges::sort(values);
    const auto n = static_cast<double>(values.size());
    double distance = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto rank = static_cast<double>(i);
        distance = std::max({distance, (rank + 1) / n - values[i], values[i] - rank / n});
    }
    return distance;
}

double p_of(const Image& a, const Image& b, bool exchangeable) {
    const auto p = p_of_same_expectation(a, b, exchangeable);
    EXPECT_TRUE(p.has_value());
    return p.value_or(std::numeric_limits<double>::quiet_NaN());
}

// Skewed noise three times the radiance. 0.085 is Kolmogorov's bound for 1000 values at
// alpha = 1e-6; the steps of the values near 1 are 0.01.
TEST(SameExpectation, IsUniformOver1000PairsOfSeeds) {
    const Image truth = lamp_picture(24);
    std::vector<double> values;
    for (uint64_t k = 0; k < 1000; ++k)
        values.push_back(
            p_of(noisy_picture(truth, 3, 2 * k), noisy_picture(truth, 3, 2 * k + 1), true));
    EXPECT_LT(distance_from_uniform(values), 0.085 + 0.01);
}

// Noise of skewness 2 against a tenth of it. Of 300 values 3 are below 0.01 on average, and more
// than 14 with a probability of 1e-6.
TEST(SameExpectation, HoldsItsLevelWhereMethodsDiffer) {
    const Image truth = even_picture(40, 32, 1);
    int below = 0;
    for (uint64_t k = 0; k < 300; ++k) {
        const Image rough = noisy_picture(truth, 1, 2 * k);
        if (p_of(rough, noisy_picture(truth, 0.1, 2 * k + 1), false) < 0.01) ++below;
    }
    EXPECT_LE(below, 14);
}

// Changes of a picture of 128 x 128, of a noise of a twentieth, and whether they are found.
class Change : public testing::Test {
  protected:
    // The larger of the two kinds of test.
    double p_against(const Image& changed) const {
        const Image a = noisy_picture(truth, 0.05, 1);
        const Image b = noisy_picture(changed, 0.05, 2);
        return std::max(p_of(a, b, true), p_of(a, b, false));
    }

    template <typename Edit>
    Image changed(const Edit& edit) const {
        Image image = truth;
        for (auto& [name, plane] : image.channels)
            for (uint32_t y = 0; y < image.height; ++y)
                for (uint32_t x = 0; x < image.width; ++x)
                    edit(x, y, plane[std::size_t{y} * image.width + x]);
        return image;
    }

    Image truth = lamp_picture(128);
};

TEST_F(Change, NoneIsNone) {
    EXPECT_GT(p_against(truth), 0.01);
    EXPECT_EQ(p_of(truth, truth, true), 1);
}

TEST_F(Change, OfAllByHalfAPercentIsFound) {
    EXPECT_LT(p_against(changed([](uint32_t, uint32_t, float& value) { value *= 1.005F; })), 1e-3);
}

TEST_F(Change, OfOneTileIsFound) {
    EXPECT_LT(
        p_against(changed([](uint32_t x, uint32_t y, float& value) {
            if (x / 16 == 2 && y / 16 == 6) value *= 1.03F;
        })),
        1e-3);
}

// A dark shape of 48 x 48 pixels goes half a pixel to the right.
TEST_F(Change, OfAnEdgeByHalfAPixelIsFound) {
    const auto shape = [&](double shift) {
        return changed([&](uint32_t x, uint32_t y, float& value) {
            const double inside =
                std::clamp(x + 1 - 20 - shift, 0.0, 1.0) * std::clamp(68 + shift - x, 0.0, 1.0);
            if (y >= 30 && y < 78) value *= static_cast<float>(1 - 0.9 * inside);
        });
    };
    const Image moved = shape(0.5);
    truth = shape(0);
    EXPECT_LT(p_against(moved), 1e-3);
}

TEST_F(Change, OfOneChannelIsFound) {
    Image image = truth;
    for (float& value : image.channels["B"]) value *= 1.01F;
    EXPECT_LT(p_against(image), 1e-3);
}

TEST_F(Change, ByRoundingIsNone) {
    EXPECT_EQ(
        p_of(truth, changed([](uint32_t, uint32_t, float& value) { value *= 1 + 2e-6F; }), true),
        1);
}

TEST(SameExpectation, IsUnknownWhereOnePixelDiffers) {
    Image a = even_picture(32, 32, 1);
    Image b = a;
    b.channels["R"][7] = 5;
    EXPECT_FALSE(p_of_same_expectation(a, b, false).has_value());
    EXPECT_GT(p_of(a, b, true), 0.5);
    a.channels["R"][7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(p_of(a, b, false), 1);
}

}  // namespace
}  // namespace wavepath
