#include "support/probe.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace wavepath {
namespace {

const Probe& probe() {
    static const Probe instance({"sampling/mis.cl"}, R"(
kernel void weights(const uint count, global float* out, global const float* pdfs) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    out[i] = power_heuristic(pdfs[2 * i], pdfs[2 * i + 1]);
}

kernel void densities(const uint count, global float* out) {
    if (get_global_id(0) >= count) return;
    out[0] = pdf_a_to_w(0.5f, 9.0f, 0.25f);
}
)");
    return instance;
}

float weight(float pdf, float other) {
    return probe().run<cl_float>("weights", 1, 1, std::vector<cl_float>{pdf, other}).front();
}

TEST(Mis, PowerHeuristic) {
    EXPECT_FLOAT_EQ(weight(3, 1), 0.9F);
    EXPECT_FLOAT_EQ(weight(1, 3), 0.1F);
    EXPECT_EQ(weight(2, 2), 0.5F);
    EXPECT_EQ(weight(2, 0), 1.0F);
    EXPECT_EQ(weight(0, 2), 0.0F);
}

TEST(Mis, HugeDensitiesDoNotOverflow) {
    EXPECT_EQ(weight(1e30F, 1e30F), 0.5F);
    EXPECT_EQ(weight(1e-30F, 1e30F), 0.0F);
    EXPECT_EQ(weight(1e30F, 1e-30F), 1.0F);
    EXPECT_EQ(weight(3e38F, 3e38F), 0.5F);
}

TEST(Mis, WeightsOfBothTechniquesSumToOne) {
    std::vector<cl_float> pdfs;
    for (const float a : {1e-6F, 0.01F, 0.3F, 1.0F, 7.0F, 1e4F})
        for (const float b : {1e-5F, 0.02F, 0.3F, 2.0F, 5e3F})
            for (const float pdf : {a, b, b, a}) pdfs.push_back(pdf);
    const auto weights = probe().run<cl_float>("weights", pdfs.size() / 2, pdfs.size() / 2, pdfs);
    for (std::size_t i = 0; i < weights.size(); i += 2)
        EXPECT_NEAR(weights[i] + weights[i + 1], 1, 2e-7) << pdfs[2 * i] << ' ' << pdfs[2 * i + 1];
}

// A light of 2 m^2 at 3 m under cosine 1/4: dA = distance^2 dw / cos.
TEST(Mis, AreaDensityToSolidAngle) {
    EXPECT_FLOAT_EQ(probe().run<cl_float>("densities", 1, 1).front(), 18);
}

}  // namespace
}  // namespace wavepath
