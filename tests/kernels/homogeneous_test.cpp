#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wavepath {
namespace {

const Probe& probe() {
    static const Probe instance(
        {"media/homogeneous.cl", "media/medium_stack.cl"},
        R"(
kernel void exponentials(const uint count, global float* out, global const float* x) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[3 * i] = exp_minus(x[i]);
    out[3 * i + 1] = minus_log(exp_minus(x[i]));
    out[3 * i + 2] = mean_of_exp_minus(x[i]);
}

// distance, stops, and the weights of the three channels
kernel void events(
    const uint count, global float* out, const float length, const float r, const float g,
    const float b, global const DeviceMedium* medium) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const MediumEvent e = sample_exponential(
        medium, length, channel_pmf(vec3(r, g, b)), unit_pair(independent_pair(i, 41)));
    out[5 * i] = e.distance;
    out[5 * i + 1] = (float)e.stops;
    out[5 * i + 2] = e.weight.x;
    out[5 * i + 3] = e.weight.y;
    out[5 * i + 4] = e.weight.z;
}

kernel void stacks(const uint count, global uint* out) {
    if (get_global_id(0) >= count) return;
    uint stack = 0;
    stack = enter_medium(stack, 3);
    stack = enter_medium(stack, 7);
    stack = enter_medium(stack, 3);
    stack = enter_medium(stack, 9);
    out[0] = innermost_medium(stack);
    out[1] = (uint)stack_is_full(stack);
    stack = leave_medium(stack, 3);  // the upper one
    out[2] = stack;
    out[3] = leave_medium(stack, 3);
    out[4] = leave_medium(stack, 5);  // not there: survives
    out[5] = leave_medium(leave_medium(leave_medium(stack, 9), 7), 3);
    out[6] = leave_medium(out[5], 3);
}
)");
    return instance;
}

TEST(Homogeneous, ExponentialsAreRight) {
    std::vector<float> x;
    for (int k = 0; k <= 8600; ++k) x.push_back(static_cast<float>(k) * 0.01F);
    for (const float small : {1e-30F, 1e-7F, 1e-4F, 0.0299F, 0.0301F}) x.push_back(small);
    const auto out = probe().run<float>("exponentials", x.size(), 3 * x.size(), x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double truth = std::exp(-double{x[i]});
        EXPECT_NEAR(out[3 * i] / truth, 1, 3e-7) << x[i];
        EXPECT_NEAR(out[3 * i + 1], -std::log(double{out[3 * i]}), 2e-7 * (1 + x[i])) << x[i];
        const double mean = x[i] > 0 ? -std::expm1(-double{x[i]}) / x[i] : 1;
        EXPECT_NEAR(out[3 * i + 2] / mean, 1, 4e-6) << x[i];
    }
    const std::vector<float> large{87, 1e4F, 1e30F, INFINITY};
    const auto ends = probe().run<float>("exponentials", large.size(), 3 * large.size(), large);
    for (std::size_t i = 0; i < large.size(); ++i) EXPECT_EQ(ends[3 * i], 0) << large[i];
}

// E[weight; passes] = exp(-sigma_t length) and E[weight; stops] = albedo (1 - exp(-sigma_t
// length)), in every channel, whatever the path carries.
TEST(Homogeneous, DistancesAreUnbiasedInEveryChannel) {
    const std::size_t n = scaled(1U << 20U);
    constexpr float sigma_t[] = {0.1F, 1, 10};
    constexpr float albedo = 0.8F;
    // as DeviceMedium lies in memory
    const std::vector<float> medium{sigma_t[0], albedo * sigma_t[0], 0, 0,
                                    sigma_t[1], albedo * sigma_t[1], 0, 0,
                                    sigma_t[2], albedo * sigma_t[2], 0, 0};
    for (const auto& carried : {std::array{1.0F, 1.0F, 1.0F}, std::array{0.1F, 3.0F, 1.0F}}) {
        const auto out = probe().run<float>(
            "events", n, 5 * n, 0.7F, carried[0], carried[1], carried[2], medium);
        for (std::size_t c = 0; c < 3; ++c) {
            Moments passes, stops;
            for (std::size_t i = 0; i < n; ++i) {
                const double weight = out[5 * i + 2 + c];
                passes.add(out[5 * i + 1] > 0 ? 0 : weight);
                stops.add(out[5 * i + 1] > 0 ? weight : 0);
            }
            const double left = std::exp(-0.7F * double{sigma_t[c]});
            constexpr double z = 5.5;
            EXPECT_NEAR(passes.mean(), left, z * passes.standard_error()) << c;
            EXPECT_NEAR(stops.mean(), albedo * (1 - left), z * stops.standard_error()) << c;
        }
    }
}

TEST(MediumStack, InnermostWinsAndUnclosedMeshesSurvive) {
    const auto out = probe().run<cl_uint>("stacks", 1, 7);
    EXPECT_EQ(out[0], 9U);
    EXPECT_EQ(out[1], 1U);
    EXPECT_EQ(out[2], 0x030709U);
    EXPECT_EQ(out[3], 0x0709U);
    EXPECT_EQ(out[4], 0x030709U);
    EXPECT_EQ(out[5], 0U);
    EXPECT_EQ(out[6], 0U);
}

}  // namespace
}  // namespace wavepath
