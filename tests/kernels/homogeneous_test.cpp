#include "shared/features.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wavepath {
namespace {

constexpr const char* kernels = R"(
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

// the same of a stop in view of a point (height 0: of none)
kernel void stops(
    const uint count, global float* out, const float length, const float along,
    const float height, global const DeviceMedium* medium) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 pmf = vec3(0.2f, 0.5f, 0.3f);
    View view = no_view();
    if (height > 0.0f)
        view = view_from(vec3(along, height, 0.0f), vec3(1.0f, 0.0f, 0.0f), length);
    const MediumEvent e = sample_stop(
        medium, length, absorptance(scale3(extinction(medium), length)), pmf, view,
        unit_pair(independent_pair(i, 43)));
    out[4 * i] = e.distance;
    out[4 * i + 1] = e.weight.x;
    out[4 * i + 2] = e.weight.y;
    out[4 * i + 3] = e.weight.z;
}

kernel void stacks(const uint count, global uint* out) {
    if (get_global_id(0) >= count) return;
    uint stack = 0;
    stack = enter_medium(stack, 3);
    stack = enter_medium(stack, 7);
    stack = enter_medium(stack, 3);
    stack = enter_medium(stack, 9);
    out[0] = innermost_medium(stack);
    out[1] = (uint)isnan(weight_of_crossing(stack, enter_medium(stack, 5), 5)) +
             10 * (uint)weight_of_crossing(stack, leave_medium(stack, 9), 9);
    stack = leave_medium(stack, 3);  // the upper one
    out[2] = stack;
    out[3] = leave_medium(stack, 3);
    out[4] = leave_medium(stack, 5);  // not there: survives
    out[5] = leave_medium(leave_medium(leave_medium(stack, 9), 7), 3);
    out[6] = leave_medium(out[5], 3);
}
)";

Probe probe_with(const std::string& defines) {
    return {{"media/homogeneous.cl", "media/medium_stack.cl"}, kernels, defines};
}

const Probe& probe() {
    static const Probe instance = probe_with("");
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

// E[weight] = albedo (1 - exp(-sigma_t length)) of stops that are certain, and the distances'
// moments: truncated exponentials of sigma_t = 1; equiangular ones on [-2, 5] from height 0.5.
TEST(Homogeneous, StopsAreUnbiasedInEveryChannel) {
    const std::size_t n = scaled(1U << 20U);
    constexpr float albedo = 0.8F;
    constexpr float length = 7;
    constexpr double z = 5.5;
    const auto medium = [&](const std::array<float, 3>& sigma_t) {
        std::vector<float> rows;
        for (const float sigma : sigma_t)
            for (const float value : {sigma, albedo * sigma, 0.0F, 0.0F}) rows.push_back(value);
        return rows;
    };
    const auto distance_is = [&](const std::vector<float>& out, double mean) {
        Moments distances;
        for (std::size_t i = 0; i < n; ++i) distances.add(out[4 * i]);
        EXPECT_NEAR(distances.mean(), mean, z * distances.standard_error());
    };
    for (const int distances :
         {DISTANCE_UNIFORM, DISTANCE_TRUNCATED, DISTANCE_EQUIANGULAR, DISTANCE_MIS}) {
        SCOPED_TRACE(distances);
        const Probe variant = probe_with(fmt::format("#define DISTANCES {}\n", distances));
        constexpr std::array sigma_t{0.02F, 0.3F, 1.0F};
        for (const float height : {0.0F, 0.5F, 1e-3F}) {
            const auto out =
                variant.run<float>("stops", n, 4 * n, length, 2.0F, height, medium(sigma_t));
            for (std::size_t c = 0; c < 3; ++c) {
                Moments weights;
                for (std::size_t i = 0; i < n; ++i) weights.add(out[4 * i + 1 + c]);
                const double truth = albedo * -std::expm1(-length * double{sigma_t[c]});
                // close to the point equiangular weights far from it are as rare as they are large
                if (height == 1e-3F && distances == DISTANCE_EQUIANGULAR) continue;
                EXPECT_NEAR(weights.mean(), truth, z * weights.standard_error()) << c;
                EXPECT_LT(weights.standard_error(), 0.01 * truth) << c;
            }
        }
        if (distances == DISTANCE_EQUIANGULAR)
            distance_is(
                variant.run<float>("stops", n, 4 * n, length, 2.0F, 0.5F, medium(sigma_t)),
                2 + .159272613286);
        if (distances == DISTANCE_TRUNCATED)
            distance_is(
                variant.run<float>("stops", n, 4 * n, 5.0F, 0.0F, 0.0F, medium({1, 1, 1})),
                .966081725468);
    }
}

TEST(MediumStack, InnermostWinsAndUnclosedMeshesSurvive) {
    const auto out = probe().run<cl_uint>("stacks", 1, 7);
    EXPECT_EQ(out[0], 9U);
    EXPECT_EQ(out[1], 11U);
    EXPECT_EQ(out[2], 0x030709U);
    EXPECT_EQ(out[3], 0x0709U);
    EXPECT_EQ(out[4], 0x030709U);
    EXPECT_EQ(out[5], 0U);
    EXPECT_EQ(out[6], 0U);
}

}  // namespace
}  // namespace wavepath
