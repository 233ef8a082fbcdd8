#include "film/auto_exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wavepath {
namespace {

Image row(const std::vector<float>& r, const std::vector<float>& g, const std::vector<float>& b) {
    return {
        .width = static_cast<uint32_t>(r.size()),
        .height = 1,
        .channels = {{"R", r}, {"G", g}, {"B", b}},
        .metadata = {}};
}

Image grey_row(const std::vector<float>& values) {
    return row(values, values, values);
}

TEST(AutoExposure, BringsTheGeometricMeanToMiddleGrey) {
    EXPECT_EQ(auto_exposure(grey_row({0.18F})), 0);
    EXPECT_EQ(auto_exposure(grey_row({0.72F, 0.72F})), -2);
    EXPECT_EQ(auto_exposure(grey_row({0.18F / 16, 0.18F, 0.18F * 4})), 0.67);  // 2/3
}

TEST(AutoExposure, WeighsColoursAsTheEyeDoes) {
    EXPECT_EQ(auto_exposure(row({0.18F / 0.2126F}, {0}, {0})), 0);
    EXPECT_EQ(auto_exposure(row({0}, {0.36F / 0.7152F}, {0})), -1);
    EXPECT_EQ(auto_exposure(row({0}, {0}, {0.09F / 0.0722F})), 1);
}

TEST(AutoExposure, LeavesOutWhatHasNoLogarithm) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(auto_exposure(grey_row({0, -1, infinity, std::nanf(""), 0.09F})), 1);
    EXPECT_EQ(auto_exposure(grey_row({0, 0})), 0);
    EXPECT_EQ(auto_exposure(grey_row({1e-40F})), 100);
}

}  // namespace
}  // namespace wavepath
