#include "measure/picture_error.h"

#include "measure/pixels.h"
#include "support/noisy_pictures.h"
#include "support/statistics.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace wavepath {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(PictureError, IsTheMeanOverPixelsAndChannels) {
    Image a = even_picture(2, 1, 1);
    const Image reference = a;
    a.channels["G"][1] = 4;  // 9 of 6 values
    EXPECT_DOUBLE_EQ(mse(a, reference).value, 1.5);
    EXPECT_DOUBLE_EQ(rel_mse(a, reference).value, 1.5 / 1.01);
    EXPECT_DOUBLE_EQ(rel_mse(reference, a).value, 1.5 / 16.01);
}

TEST(PictureError, LeavesOutWhatIsNotFinite) {
    Image a = even_picture(3, 1, 1);
    const Image reference = even_picture(3, 1, 2);
    a.channels["B"][0] = nan;
    a.channels["R"][2] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(mse(a, reference).value, 1);
    EXPECT_EQ(mse(a, reference).left_out, 2U);
    EXPECT_EQ(rel_mse(reference, reference, a).left_out, 2U);
    EXPECT_EQ(ratio_of_means(a, reference).left_out, 2U);
    EXPECT_EQ(ratio_of_means(a, reference).value, 0.5);
    a.channels["G"][1] = nan;
    EXPECT_TRUE(std::isnan(mse(a, reference).value));
}

// A noise of 0.1 in A, of 0.2 in each half: by the mean of the halves 0.02 would be added to 0.01.
// Judged at alpha = 1e-6 by 320 pictures, with a power of 0.99 for a tenth of 0.01.
TEST(PictureError, OfTwoHalvesLacksTheirNoise) {
    const Image truth = even_picture(16, 16, 1);
    Moments by_halves;
    for (uint64_t k = 0; k < 320; ++k) {
        const Image a = noisy_picture(truth, 0.1, 3 * k);
        const Image half1 = noisy_picture(truth, 0.2, 3 * k + 1);
        const Image half2 = noisy_picture(truth, 0.2, 3 * k + 2);
        by_halves.add(mse(a, half1, half2).value);
    }
    EXPECT_TRUE(mean_is(by_halves, 0.01, 1, 0.1));
}

// The noise in the denominator, 0.035 of R, is of third order in the noise: 0.4 % at most.
TEST(PictureError, OfTheHalvesIsTheirMeans) {
    const Image truth = even_picture(16, 16, 1);
    Moments own;
    for (uint64_t k = 0; k < 256; ++k)
        own.add(rel_mse_of_halves(
                    noisy_picture(truth, 0.05, 2 * k), noisy_picture(truth, 0.05, 2 * k + 1))
                    .value);
    EXPECT_TRUE(mean_is(own, 0.00125 / 1.01, 1, 0.05, 0.004));
}

// The ratio's error against its true spread, by 200 pairs: a variance of 200 is known to 10 %, so
// that 1.5 is five standard errors off.
TEST(RatioOfMeans, SaysItsStandardError) {
    const Image truth = lamp_picture(32);
    Moments ratios;
    Moments squared_errors;
    for (uint64_t k = 0; k < 200; ++k) {
        const Ratio ratio =
            ratio_of_means(noisy_picture(truth, 0.3, 2 * k), noisy_picture(truth, 0.3, 2 * k + 1));
        ratios.add(ratio.value);
        squared_errors.add(ratio.standard_error * ratio.standard_error);
    }
    EXPECT_LT(std::abs(ratios.mean() - 1), 5 * ratios.standard_error());
    EXPECT_LT(squared_errors.mean(), 1.5 * ratios.variance());
    EXPECT_GT(squared_errors.mean(), ratios.variance() / 1.5);
}

TEST(VarianceOver, IsThatOfThePixel) {
    const std::vector<Image> pictures{
        even_picture(1, 1, 1), even_picture(1, 1, 2), even_picture(1, 1, 6)};
    EXPECT_EQ(variance_over(pictures).channels.at("G")[0], 7);
}

TEST(RelativeDeviations, AreWhatRelMseSquares) {
    const Image truth = lamp_picture(8);
    const Image a = noisy_picture(truth, 0.2, 1);
    double sum = 0;
    const std::vector<double> deviations = relative_deviations(a, truth);
    for (const double x : deviations) sum += x * x;
    EXPECT_NEAR(sum / static_cast<double>(deviations.size()), rel_mse(a, truth).value, 1e-12);
}

TEST(CheckComparable, NamesWhatDiffers) {
    const Image a = even_picture(4, 2, 1);
    Image b = even_picture(4, 3, 1);
    EXPECT_THAT(
        error_of([&] { check_comparable(a, "a.exr", b, "b.exr"); }),
        AllOf(HasSubstr("a.exr has 4 x 2"), HasSubstr("b.exr has 4 x 3")));
    b.channels.erase("G");
    EXPECT_THAT(
        error_of([&] { check_comparable(a, "a.exr", b, "b.exr"); }),
        HasSubstr("b.exr: has no channel G"));
    EXPECT_NO_THROW(check_comparable(a, "a.exr", a, "b.exr"));
}

}  // namespace
}  // namespace wavepath
