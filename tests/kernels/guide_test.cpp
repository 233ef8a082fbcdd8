#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace wavepath {
namespace {

const std::string text = R"(
kernel void directions(const uint count, global float* out, const float distance) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    RenderParams params;
    params.guide_x = 0.48f * distance;
    params.guide_y = -0.6f * distance;
    params.guide_z = 0.64f * distance;
    params.guide_radius2 = 0.01f;
    const Guide guide = guide_at(&params, vec3(0.0f, 0.0f, 0.0f), 0);
    Sample2 u = unit_pair(independent_pair(i, 29));
    const int guided = choose_guided(guide, &u);
    const Vec3 wi = guided ? guide_sample(guide, u) : sample_sphere(u);
    out[6 * i] = guide.share;
    out[6 * i + 1] = 1.0f - dot3(wi, guide.axis);
    out[6 * i + 2] = atan2_turns(dot3(wi, vec3(0.8f, 0.0f, -0.6f)),
                                 dot3(wi, vec3(0.36f, 0.8f, 0.48f))) + 0.5f;
    out[6 * i + 3] = guided_pdf_w(guide, guided, wi, 0.25f * INV_PI_F);
    out[6 * i + 4] = guide.one_minus_cos;
    out[6 * i + 5] = guided;
}
)";

const Probe& probe() {
    static const Probe instance({"lights/guide.cl"}, text);
    return instance;
}

// chi-square of the mixture with uniform directions over rings round the axis and sectors of them,
// and the density that weighs each direction against what was drawn: the mean of 1 / pdf is 4 pi.
TEST(Guide, DirectionsFollowTheirDensity) {
    for (const float distance : {0.15F, 0.4F, 1.0F}) {
        const std::size_t n = scaled(1U << 20U);
        const auto out = probe().run<float>("directions", n, 6 * n, distance);
        const double share = out[0];
        const double rim = out[4];
        EXPECT_NEAR(share, 0.2, 1e-6);
        EXPECT_NEAR(rim, 1 - std::sqrt(1 - 0.01 / (distance * distance)), 1e-6);
        constexpr std::size_t sectors = 8;
        const std::vector<double> rings{0, rim / 3, 2 * rim / 3, rim, (rim + 2) / 2, 2};
        std::vector<unsigned> counts(sectors * (rings.size() - 1));
        std::vector<double> expected(counts.size());
        double inverse = 0;
        for (std::size_t i = 0; i < n; ++i) {
            std::size_t ring = 0;
            while (ring + 2 < rings.size() && out[6 * i + 1] > rings[ring + 1]) ++ring;
            const auto sector = std::min<std::size_t>(
                sectors - 1, static_cast<std::size_t>(out[6 * i + 2] * sectors));
            ++counts[ring * sectors + sector];
            inverse += 1 / static_cast<double>(out[6 * i + 3]) / static_cast<double>(n);
        }
        for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
            const double width = rings[ring + 1] - rings[ring];
            const double chance = (1 - share) * width / 2 + (ring < 3 ? share * width / rim : 0);
            for (std::size_t s = 0; s < sectors; ++s)
                expected[ring * sectors + s] = chance / sectors * static_cast<double>(n);
        }
        EXPECT_TRUE(counts_follow(counts, expected, 3)) << distance;
        // 1 / pdf is at most 4 pi / 0.8: its mean is known to 4 pi / 0.8 / sqrt(n), 6 times over
        const double whole = 4 * std::numbers::pi;
        EXPECT_NEAR(inverse / whole, 1, 6 / 0.8 / std::sqrt(static_cast<double>(n))) << distance;
    }
}

// A direction at the rim that is taken for one outside weighs thousands of times too much.
TEST(Guide, RimsOfNarrowConesWeighByTheCone) {
    const std::size_t n = scaled(1U << 20U);
    const auto out = probe().run<float>("directions", n, 6 * n, 1000.0F);
    const double cone = 1 / (2 * std::numbers::pi * static_cast<double>(out[4]));
    EXPECT_NEAR(out[4], 5e-9, 1e-12);
    std::size_t guided = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (out[6 * i + 5] == 0) continue;
        ++guided;
        ASSERT_GE(out[6 * i + 3], 0.199 * cone) << i;
    }
    EXPECT_GT(guided, n / 6);
}

TEST(Guide, AimsNowhereFromCloseBy) {
    const auto out = probe().run<float>("directions", 1, 6, 0.105F);
    EXPECT_EQ(out[0], 0);
    EXPECT_NEAR(out[3], 0.25 / std::numbers::pi, 1e-7);
}

}  // namespace
}  // namespace wavepath
