#include "support/grid.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wavepath {
namespace {

const Grid grid;

const Probe& probe() {
    static const Probe instance({"sampling/sobol.cl"}, grid_functions(grid) + R"(
kernel void units(const uint count, global float* out, global const uint* bits) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = unit_float(bits[i]);
}

kernel void hashes(const uint count, global uint* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = hash_uint(i);
}

// (u, v) of points i of one stream
kernel void stream(const uint count, global uint* out, const uint seed) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Sample2 s = unit_pair(independent_pair(reverse_bits_32(i), seed));
    grid_count(out, s.u, s.v);
}

// u of the same point in two streams: neighbouring pixels
kernel void neighbours(const uint count, global uint* out, const uint seed) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Sample2 a = unit_pair(independent_pair(0, hash_pair(seed, i)));
    const Sample2 b = unit_pair(independent_pair(0, hash_pair(seed, i + 1)));
    grid_count(out, a.u, b.u);
}

// mean of u over n points of stream i
kernel void block_means(const uint count, global float* out, const uint seed, const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    float sum = 0.0f;
    for (uint k = 0; k < n; ++k)
        sum += unit_pair(independent_pair(reverse_bits_32(k), hash_pair(seed, i))).u - 0.5f;
    out[i] = sum / (float)n;
}
)");
    return instance;
}

TEST(Rng, UnitFloatStaysBelowOne) {
    const std::vector<cl_uint> bits{0, 1, 0xFFU, 0x100U, 0x80000000U, 0xFFFFFF00U, 0xFFFFFFFFU};
    const auto units = probe().run<cl_float>("units", bits.size(), bits.size(), bits);
    EXPECT_EQ(units.front(), 0.0F);
    EXPECT_EQ(units[3], 0x1p-24F);
    EXPECT_EQ(units[4], 0.5F);
    EXPECT_EQ(units.back(), 1 - 0x1p-24F);
}

// Every input bit flips every output bit with probability 1/2 (strict avalanche): z-tests of 1024
// frequencies.
TEST(Rng, HashAvalanches) {
    const std::size_t inputs = scaled(1U << 16U);
    const auto hashes = probe().run<cl_uint>("hashes", 2 * inputs, 2 * inputs);
    // bits below 2^16 have both values among the inputs
    const double critical = normal_critical(0.5 * sidak(false_alarm, std::size_t{16} * 32));
    for (unsigned in = 0; in < 16 && (2U << in) <= 2 * inputs; ++in) {
        std::vector<double> flips(32);
        for (std::size_t i = 0; i < inputs; ++i) {
            const cl_uint changed = hashes[i] ^ hashes[i ^ (std::size_t{1} << in)];
            for (unsigned out = 0; out < 32; ++out) flips[out] += (changed >> out) & 1U;
        }
        // pairs (i, i^bit) come twice
        const double deviation = std::sqrt(0.5 * static_cast<double>(inputs));
        for (unsigned out = 0; out < 32; ++out)
            EXPECT_LT(
                std::abs(flips[out] - 0.5 * static_cast<double>(inputs)), critical * deviation)
                << in << " -> " << out;
    }
}

// alpha: false_alarm over three pairs of grids; power in support/grid.h.
TEST(Rng, StreamsAreUniform) {
    std::vector<double> uniform(grid.cells() + 1, 1 / static_cast<double>(grid.cells()));
    uniform.back() = 0;
    const std::size_t samples = scaled(1U << 22U);
    for (const cl_uint seed : {1U, 0xDEADBEEFU})
        expect_distribution(
            grid, probe().run<cl_uint>("stream", samples, grid.cells() + 1, seed), uniform, 3);
    expect_distribution(
        grid, probe().run<cl_uint>("neighbours", samples, grid.cells() + 1, cl_uint{5}), uniform,
        3);
}

// n Var(block means) = Var(u) = 1/12 unless streams repeat each other; the band is 5 deviations,
// sqrt(2 / blocks).
TEST(Rng, BlocksAreIndependent) {
    constexpr cl_uint n = 64;
    const std::size_t blocks = scaled(1U << 16U);
    Moments means;
    for (const float mean : probe().run<cl_float>("block_means", blocks, blocks, cl_uint{3}, n))
        means.add(mean);
    EXPECT_NEAR(12 * n * means.variance(), 1, 5 * std::sqrt(2 / static_cast<double>(blocks)));
    EXPECT_LT(std::abs(means.mean()), 5 * means.standard_error());
}

}  // namespace
}  // namespace wavepath
