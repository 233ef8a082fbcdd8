#include "support/grid.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace wavepath {
namespace {

const Grid grid;
constexpr cl_uint net_bits = 8;  // nets of up to 2^8 points

const Probe& probe() {
    static const Probe instance({"sampling/dimensions.cl"}, grid_functions(grid) + R"(
// points first .. first + 255 of seed i: pairs of bits
kernel void nets(const uint count, global uint* out, const uint first) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    for (uint k = 0; k < 256; ++k) {
        const Bits2 b = sobol_pair(reverse_bits_32(first + k), hash_uint(i));
        out[512 * i + 2 * k] = b.u;
        out[512 * i + 2 * k + 1] = b.v;
    }
}

kernel void reversals(const uint count, global uint* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = reverse_bits_32(reverse_bits_32(hash_uint(i)) >> 7) ^ (hash_uint(i) << 7);
}

kernel void scrambles(const uint count, global uint* out, const uint seed) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = scramble_upwards(i, seed) & 0xFFFF;
}

// point 0 (a pixel's only sample) over many pixels
kernel void first_points(const uint count, global uint* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Sample2 s = unit_pair(dimension_pair(hash_uint(i), 0, PAIR_PIXEL, 1));
    grid_count(out, s.u, s.v);
}

// u of one decision against u of another, at point `index` of many pixels
kernel void decisions(
    const uint count, global uint* out, const uint index, const uint a, const uint b) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const uint reversed = reverse_bits_32(index);
    const Sample2 p = unit_pair(dimension_pair(hash_uint(i), reversed, a, 1));
    const Sample2 q = unit_pair(dimension_pair(hash_uint(i), reversed, b, 1));
    grid_count(out, p.u, q.u);
}

// u of neighbouring pixels at one point
kernel void pixels(const uint count, global uint* out, const uint index) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const uint reversed = reverse_bits_32(index);
    const Sample2 p = unit_pair(sobol_pair(reversed, hash_pair(i, PAIR_PIXEL)));
    const Sample2 q = unit_pair(sobol_pair(reversed, hash_pair(i + 1, PAIR_PIXEL)));
    grid_count(out, p.v, q.v);
}
// error of the mean of u^2 v over n points of seed i
kernel void integrals(const uint count, global float* out, const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    float sum = 0.0f;
    for (uint k = 0; k < n; ++k) {
        const Sample2 s = unit_pair(sobol_pair(reverse_bits_32(k), hash_uint(i)));
        sum += s.u * s.u * s.v;
    }
    out[i] = sum / (float)n;
}
)");
    return instance;
}

// Whether each of the 2^a x 2^(k-a) boxes holds exactly one of the 2^k points, for every a: a (0,
// k, 2)-net.
bool is_net(const cl_uint* points, cl_uint k) {
    for (cl_uint a = 0; a <= k; ++a) {
        std::vector<bool> taken(std::size_t{1} << k);
        for (std::size_t i = 0; i < taken.size(); ++i) {
            const auto column = static_cast<std::size_t>(cl_ulong{points[2 * i]} >> (32 - a));
            const auto row =
                static_cast<std::size_t>(cl_ulong{points[2 * i + 1]} >> (32 - (k - a)));
            const std::size_t box = (column << (k - a)) | row;
            if (taken[box]) return false;
            taken[box] = true;
        }
    }
    return true;
}

TEST(Sobol, EveryPrefixAndAlignedBlockIsANet) {
    const std::size_t seeds = scaled(2000);
    for (const cl_uint first : {0U, 256U, 1U << 20U}) {
        const auto points = probe().run<cl_uint>("nets", seeds, 512 * seeds, first);
        for (std::size_t seed = 0; seed < seeds; ++seed)
            for (cl_uint k = 0; k <= net_bits; ++k)
                ASSERT_TRUE(is_net(&points[512 * seed], k))
                    << "seed " << seed << ", " << (1U << k) << " points from " << first;
    }
}

TEST(Sobol, BitReversal) {
    for (const cl_uint difference : probe().run<cl_uint>("reversals", 1024, 1024))
        ASSERT_EQ(difference, 0U);
}

// An Owen scramble permutes: on the low 16 bits, which depend on nothing above them.
TEST(Sobol, ScrambleIsAPermutation) {
    for (const cl_uint seed : {0U, 1U, 0x80000000U, 0xFFFFFFFFU, 0x12345678U}) {
        const auto scrambled = probe().run<cl_uint>("scrambles", 1U << 16U, 1U << 16U, seed);
        EXPECT_EQ(std::set<cl_uint>(scrambled.begin(), scrambled.end()).size(), 1U << 16U) << seed;
    }
}

// alpha: false_alarm over the pairs of grids; power in support/grid.h.
TEST(Sobol, PointsAreUniformAndIndependentOverSeeds) {
    std::vector<double> uniform(grid.cells() + 1, 1 / static_cast<double>(grid.cells()));
    uniform.back() = 0;
    const std::size_t samples = scaled(1U << 20U);
    const std::size_t results = grid.cells() + 1;
    constexpr std::size_t comparisons = 8;
    expect_distribution(
        grid, probe().run<cl_uint>("first_points", samples, results), uniform, comparisons);
    for (const cl_uint index : {0U, 1U, 37U}) {
        expect_distribution(
            grid, probe().run<cl_uint>("decisions", samples, results, index, 0U, 1U), uniform,
            comparisons);
        expect_distribution(
            grid, probe().run<cl_uint>("pixels", samples, results, index), uniform, comparisons);
    }
    expect_distribution(
        grid, probe().run<cl_uint>("decisions", samples, results, 5U, 4U, 30U), uniform,
        comparisons);
}

// Over seeds the mean is right (alpha: false_alarm) and its variance falls as n^-3: scrambled nets
// on a smooth integrand, against n^-1 of independent points (Owen 1997).
TEST(Sobol, ErrorFallsFasterThanAtRandom) {
    const std::size_t seeds = scaled(4096);
    const auto moments = [&](cl_uint n) {
        Moments m;
        for (const float mean : probe().run<cl_float>("integrals", seeds, seeds, n)) m.add(mean);
        return m;
    };
    const Moments few = moments(16);
    const Moments many = moments(256);
    if (seeds >= 128) {
        EXPECT_TRUE(mean_is(few, 1.0 / 6, 2));
        EXPECT_TRUE(mean_is(many, 1.0 / 6, 2));
    }
    const double slope = std::log(many.variance() / few.variance()) / std::log(16.0);
    EXPECT_LT(slope, -2.4);
}

}  // namespace
}  // namespace wavepath
