#include "prepare/alias_table.h"
#include "shared/scene.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace wavepath {
namespace {

const Probe& probe() {
    static const Probe instance({"lights/light_choice.cl"}, R"(
kernel void choices(
    const uint count, global uint* out, global const DeviceLight* lights, const uint light_count,
    const uint stratified) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Bits2 bits = stratified ? sobol_pair(reverse_bits_32(i), 41) : independent_pair(i, 41);
    atomic_inc(out + choose_light(lights, light_count, bits.u));
}
)");
    return instance;
}

std::vector<DeviceLight> lights_of(const std::vector<double>& weights) {
    std::vector<DeviceLight> lights;
    for (const AliasRow& row : build_alias_table(weights)) {
        DeviceLight light{};
        light.alias_threshold = row.threshold;
        light.alias = row.alias;
        light.pmf = row.pmf;
        lights.push_back(light);
    }
    return lights;
}

std::vector<double> uneven_weights(std::size_t n) {
    std::vector<double> weights(n);
    for (std::size_t i = 0; i < n; ++i) weights[i] = 1.0 + static_cast<double>(i * i % 17);
    weights[n / 2] = 0;
    weights[n / 3] = 40.0 * static_cast<double>(n);
    return weights;
}

// alpha: false_alarm over the tables. With N = 2^22 and up to 200 lights a pmf off by +-0.7 % over
// half of the table is found with probability .99.
TEST(LightChoice, FollowsThePmf) {
    for (const std::size_t n :
         {std::size_t{1}, std::size_t{2}, std::size_t{37}, std::size_t{200}}) {
        const std::vector<double> weights = n < 3 ? std::vector<double>(n, 2.0) : uneven_weights(n);
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        const std::size_t samples = scaled(1U << 22U);
        const auto lights = lights_of(weights);
        const auto counts = probe().run<cl_uint>(
            "choices", samples, n, lights, static_cast<cl_uint>(n), cl_uint{0});
        std::vector<double> expected(n);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_NEAR(lights[i].pmf, weights[i] / sum, 1e-7) << i;
            expected[i] = weights[i] / sum * static_cast<double>(samples);
        }
        EXPECT_TRUE(counts_follow(counts, expected, 4)) << n << " lights";
    }
}

// Exact: 2^k stratified numbers differ from 2^k pmf by at most a number at each end of the
// intervals of a light, of which the table has at most one an entry that names it and one more.
TEST(LightChoice, KeepsStratification) {
    const std::vector<double> weights = uneven_weights(37);
    const auto lights = lights_of(weights);
    constexpr std::size_t samples = 1U << 14U;
    const auto counts =
        probe().run<cl_uint>("choices", samples, 37, lights, cl_uint{37}, cl_uint{1});
    for (std::size_t i = 0; i < 37; ++i) {
        double ends = 2;
        for (const DeviceLight& light : lights) ends += light.alias == i ? 2 : 0;
        EXPECT_NEAR(counts[i], lights[i].pmf * samples, ends) << i;
    }
}

// The device tells 2^24 thresholds apart: a light of a millionth of the weight has the probability
// that this leaves it, not the one asked for.
TEST(LightChoice, PmfIsWhatTheThresholdsGive) {
    const std::vector<AliasRow> table = build_alias_table({1, 1e-7, 1e-9, 3, 2e-6});
    std::vector<double> chances(table.size(), 0.0);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double kept = std::ceil(double{table[i].threshold} * 0x1p24) * 0x1p-24;
        chances[i] += kept / 5;
        chances[table[i].alias] += (1 - kept) / 5;
    }
    for (std::size_t i = 0; i < table.size(); ++i)
        EXPECT_NEAR(table[i].pmf / chances[i], 1, 1e-6) << "entry " << i;
}

}  // namespace
}  // namespace wavepath
