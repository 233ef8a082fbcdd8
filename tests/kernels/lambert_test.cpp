#include "support/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace wavepath {
namespace {

// lambert_sample is sample_cosine, whose distribution warp_test checks.
TEST(Lambert, ValueAndDensity) {
    const Probe probe({"materials/lambert.cl"}, R"(
kernel void lobes(const uint count, global float* out, global const float* cosines) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 wi = vec3(sqrt(1.0f - cosines[i] * cosines[i]), 0.0f, cosines[i]);
    out[2 * i] = lambert_eval(wi);
    out[2 * i + 1] = lambert_pdf_w(wi);
}
)");
    const std::vector<cl_float> cosines{1, 0.5F, 1e-30F, 0, -0.0F, -0.5F, -1};
    const auto out = probe.run<cl_float>("lobes", cosines.size(), 2 * cosines.size(), cosines);
    for (std::size_t i = 0; i < cosines.size(); ++i) {
        const float expected = std::fmax(cosines[i], 0.0F) * std::numbers::inv_pi_v<float>;
        EXPECT_FLOAT_EQ(out[2 * i], expected) << cosines[i];
        EXPECT_EQ(out[2 * i], out[2 * i + 1]) << "weight is the albedo";
    }
}

}  // namespace
}  // namespace wavepath
