#include "support/grid.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace wavepath {
namespace {

using std::numbers::pi;

const Grid grid;

const Probe& probe() {
    static const Probe instance({"sampling/warp.cl"}, grid_functions(grid) + R"(
kernel void sines(const uint count, global float* out, global const float* u) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const SineCosine s = sincos_2pi(u[i]);
    out[2 * i] = s.sine;
    out[2 * i + 1] = s.cosine;
}

kernel void arcs(const uint count, global float* out, global const float* yx) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = atan2_turns(yx[2 * i], yx[2 * i + 1]);
}

kernel void arc_cosines(const uint count, global float* out, global const float* z) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = acos_half_turns(z[i]);
}

INLINE Sample2 point(const uint i) {
    return unit_pair(independent_pair(i, 77));
}

// by the builtin atan2, not the one under test
INLINE float turn(const Vec3 d) {
    return atan2(d.y, d.x) * (0.5f * INV_PI_F) + 0.5f;
}

kernel void cosine_points(const uint count, global uint* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 d = sample_cosine(point(i));
    grid_count(out, d.z, turn(d));
}

kernel void sphere_points(const uint count, global uint* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 d = sample_sphere(point(i));
    grid_count(out, 0.5f * d.z + 0.5f, turn(d));
}

// b / (a + b + c) over 1 - a: both uniform apart from the square in (1 - a)
kernel void triangle_points(const uint count, global uint* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Sample2 b = sample_triangle(point(i));
    const float sum = b.u + b.v;
    grid_count(out, sum, sum > 0.0f ? b.v / sum : 0.0f);
}

// means over n samples, 4 an item: cosine z, z^2, x^2; sphere z^2, z^4; triangle b1, b1 b2; worst |length - 1|
kernel void means(const uint count, global float* out, const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    float sums[7] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    float worst = 0.0f;
    for (uint k = 0; k < n; ++k) {
        const Sample2 u = point(i * n + k);
        const Vec3 c = sample_cosine(u);
        const Vec3 s = sample_sphere(u);
        const Sample2 b = sample_triangle(u);
        sums[0] += c.z;
        sums[1] += c.z * c.z;
        sums[2] += c.x * c.x;
        sums[3] += s.z * s.z;
        sums[4] += s.z * s.z * s.z * s.z;
        sums[5] += b.u;
        sums[6] += b.u * b.v;
        worst = max(worst, max(fabs(dot3(c, c) - 1.0f), fabs(dot3(s, s) - 1.0f)));
    }
    for (int k = 0; k < 7; ++k) out[8 * i + k] = sums[k] / (float)n;
    out[8 * i + 7] = worst;
}
)");
    return instance;
}

// n points from low to high, ends included.
std::vector<cl_float> sweep(double low, double high, std::size_t n) {
    std::vector<cl_float> values(n);
    for (std::size_t i = 0; i < n; ++i)
        values[i] = static_cast<cl_float>(
            low + (high - low) * static_cast<double>(i) / static_cast<double>(n - 1));
    return values;
}

// The bounds below are those that kernels/sampling/warp.cl states.
TEST(Warp, SincosError) {
    const auto u = sweep(-1, 1, scaled(1U << 20U) + 1);
    const auto out = probe().run<cl_float>("sines", u.size(), 2 * u.size(), u);
    double worst = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        worst = std::max(worst, std::abs(out[2 * i] - std::sin(2 * pi * u[i])));
        worst = std::max(worst, std::abs(out[2 * i + 1] - std::cos(2 * pi * u[i])));
    }
    EXPECT_LT(worst, 2e-7) << worst;
}

TEST(Warp, Atan2Error) {
    std::vector<cl_float> yx;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-pi, pi);
    std::uniform_real_distribution<double> magnitude(-20, 20);
    for (std::size_t i = 0; i < scaled(1U << 20U); ++i) {
        const double a = angle(random);
        const double r = std::exp(magnitude(random));
        yx.push_back(static_cast<cl_float>(r * std::sin(a)));
        yx.push_back(static_cast<cl_float>(r * std::cos(a)));
    }
    for (const float y : {0.0F, 1.0F, -1.0F, 1e-20F, 1e20F})
        for (const float x : {1.0F, -1.0F, 1e-20F, -1e20F}) yx.insert(yx.end(), {y, x});
    const auto out = probe().run<cl_float>("arcs", yx.size() / 2, yx.size() / 2, yx);
    double worst = 0;
    for (std::size_t i = 0; i < out.size(); ++i)
        worst = std::max(
            worst,
            std::abs(out[i] - std::atan2(double{yx[2 * i]}, double{yx[2 * i + 1]}) / (2 * pi)));
    EXPECT_LT(worst, 1e-7) << worst;
}

TEST(Warp, Atan2OfNothingIsZero) {
    EXPECT_EQ(probe().run<cl_float>("arcs", 1, 1, std::vector<cl_float>{0, 0}).front(), 0.0F);
}

TEST(Warp, AcosError) {
    auto z = sweep(-1, 1, scaled(1U << 20U) + 1);
    for (double tilt = 1; tilt > 1e-8; tilt *= 0.9)
        for (const double sign : {-1.0, 1.0}) z.push_back(static_cast<cl_float>(sign * (1 - tilt)));
    const auto out = probe().run<cl_float>("arc_cosines", z.size(), z.size(), z);
    double worst = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        worst = std::max(worst, std::abs(out[i] - std::acos(double{z[i]}) / pi));
        ASSERT_GE(out[i], 0.0F);
        ASSERT_LE(out[i], 1.0F);
    }
    EXPECT_LT(worst, 2e-7) << worst;
}

// alpha: false_alarm over three pairs of grids; power in support/grid.h.
TEST(Warp, SamplesFollowTheirDensities) {
    const std::size_t samples = scaled(1U << 22U);
    const auto expect = [&](const char* kernel, auto density) {
        std::vector<double> densities;
        for (const Point2& p : grid_nodes(grid)) densities.push_back(density(p));
        expect_distribution(
            grid, probe().run<cl_uint>(kernel, samples, grid.cells() + 1),
            grid_probabilities(grid, densities), 3);
    };
    expect("cosine_points", [](const Point2& p) { return 2 * p[0]; });
    expect("sphere_points", [](const Point2&) { return 1.0; });
    expect("triangle_points", [](const Point2& p) { return 2 * p[0]; });
}

// alpha: false_alarm over the seven means; each finds a bias of 0.5 % with probability .99.
TEST(Warp, Moments) {
    constexpr std::size_t batches = 1024;
    const auto n = static_cast<cl_uint>(scaled(8192));
    const auto out = probe().run<cl_float>("means", batches, 8 * batches, n);
    const std::vector<double> truths{2.0 / 3, 0.5, 0.25, 1.0 / 3, 0.2, 1.0 / 3, 1.0 / 12};
    for (std::size_t k = 0; k < truths.size(); ++k) {
        Moments moments;
        for (std::size_t i = 0; i < batches; ++i) moments.add(out[8 * i + k]);
        EXPECT_TRUE(mean_is(moments, truths[k], truths.size(), 0.005)) << "moment " << k;
    }
    for (std::size_t i = 0; i < batches; ++i) EXPECT_LT(out[8 * i + 7], 1e-6F);
}

}  // namespace
}  // namespace wavepath
