#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace wavepath {
namespace {

using std::numbers::pi;

// Close to what the glTF reader lets through (.99999), and down to where 1 / g formulas have no
// digits left.
constexpr double anisotropies[] = {0,    1e-6, -1e-6, 1e-3,  -1e-3,  0.3,
                                   -0.5, 0.75, 0.99,  -0.99, 0.9999, -0.9999};

const std::string text = R"(
constant float travel[3] = {0.48f, -0.6f, 0.64f};

kernel void directions(const uint count, global float* out, const float g) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 direction = vec3(travel[0], travel[1], travel[2]);
    const PhaseSample s = phase_sample(g, direction, unit_pair(independent_pair(i, 31)));
    const float value = phase_eval(g, direction, s.wi);
    out[6 * i] = s.wi.x;
    out[6 * i + 1] = s.wi.y;
    out[6 * i + 2] = s.wi.z;
    out[6 * i + 3] = s.pdf_w;
    out[6 * i + 4] = value;
    out[6 * i + 5] = s.weight;
}
)";

struct Sampled {
    double d;  // 1 - cos between the directions of travel; g < 0: 1 + cos
    double cosine, turn, pdf_w, value, weight;
};

std::vector<Sampled> sample(double g, std::size_t n, const std::string& defines = "") {
    const Probe probe({"media/phase.cl"}, text, defines);
    const auto out = probe.run<float>("directions", n, 6 * n, static_cast<float>(g));
    const std::array<double, 3> w{0.48F, -0.6F, 0.64F};
    std::vector<Sampled> samples;
    for (std::size_t i = 0; i < n; ++i) {
        const float* s = &out[6 * i];
        double step = 0;
        double cosine = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            step += std::pow(s[k] + (g < 0 ? w[k] : -w[k]), 2);
            cosine += s[k] * w[k];
        }
        // about w: (0.8, 0, -0.6) is normal to it, and their cross product (0.36, 0.8, 0.48)
        const double turn =
            std::atan2(0.8 * s[0] - 0.6 * s[2], 0.36 * s[0] + 0.8 * s[1] + 0.48 * s[2]);
        samples.push_back({step / 2, cosine, turn / (2 * pi) + 0.5, s[3], s[4], s[5]});
    }
    return samples;
}

// Share of directions with less than this d: the cumulative density, from d = 0 on.
double cumulative(double a, double d) {
    if (a < 1e-4) return d / 2;
    // (1 - a^2) / (2 a) [1 / (1 - a) - 1 / sqrt((1 - a)^2 + 2 a d)], multiplied out
    const double low = 1 - a;
    const double root = std::sqrt(low * low + 2 * a * d);
    return (1 + a) * d / (root * (root + low));
}

double density(double a, double d) {
    return (1 - a * a) / (4 * pi * std::pow((1 - a) * (1 - a) + 2 * a * d, 1.5));
}

TEST(Phase, DirectionsFollowHenyeyGreenstein) {
    const std::size_t n = scaled(1U << 18U);
    constexpr std::size_t bins = 64;
    for (const double g : anisotropies) {
        SCOPED_TRACE(g);
        const double a = std::abs(static_cast<float>(g));
        std::vector<uint32_t> counts(bins * 4);
        for (const Sampled& s : sample(g, n)) {
            const auto bin =
                static_cast<std::size_t>(std::min(cumulative(a, s.d), 0.9999999) * bins);
            const auto quarter = static_cast<std::size_t>(std::min(s.turn, 0.9999999) * 4);
            ++counts[4 * bin + quarter];
        }
        EXPECT_TRUE(counts_follow(
            counts, std::vector<double>(counts.size(), static_cast<double>(n) / (bins * 4.0)),
            std::size(anisotropies)));
    }
}

TEST(Phase, HasTheMeanCosineAndItsSquare) {
    const std::size_t n = scaled(1U << 18U);
    for (const double g : anisotropies) {
        SCOPED_TRACE(g);
        Moments cosine, square;
        for (const Sampled& s : sample(g, n)) {
            cosine.add(s.cosine);
            square.add(s.cosine * s.cosine);
        }
        constexpr double z = 5.5;  // 24 comparisons at 1e-6
        EXPECT_NEAR(cosine.mean(), g, z * cosine.standard_error() + 1e-7);
        EXPECT_NEAR(square.mean(), (1 + 2 * g * g) / 3, z * square.standard_error() + 2e-7);
    }
}

// By difference vectors: a cosine near 1 has no digits left.
TEST(Phase, DensityKeepsItsDigits) {
    for (const double g : anisotropies) {
        SCOPED_TRACE(g);
        const double a = std::abs(static_cast<float>(g));
        // directions are rounded to 6e-8, seen against the lobe's width 1 - a
        const double tolerance = 1e-5 + 1e-6 / (1 - a);
        for (const Sampled& s : sample(g, scaled(4096))) {
            EXPECT_NEAR(s.value / density(a, s.d), 1, tolerance);
            EXPECT_NEAR(s.pdf_w / density(a, s.d), 1, tolerance);
            EXPECT_EQ(s.weight, 1);
        }
    }
}

TEST(Phase, UniformDirectionsWeighByTheRatio) {
    Moments weight;
    for (const Sampled& s : sample(0.75, scaled(1U << 16U), "#define PHASE_DIRECTIONS 0\n")) {
        EXPECT_FLOAT_EQ(static_cast<float>(s.pdf_w), static_cast<float>(1 / (4 * pi)));
        weight.add(s.weight);
    }
    // relative variance (1 + g^2) / (1 - g^2)^2 - 1
    EXPECT_NEAR(weight.mean(), 1, 5 * weight.standard_error());
    if (test_scale() < 1) return;
    EXPECT_NEAR(weight.variance() / 7.1632653, 1, 0.1);
}

}  // namespace
}  // namespace wavepath
