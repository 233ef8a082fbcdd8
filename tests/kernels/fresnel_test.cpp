#include "support/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wavepath {
namespace {

TEST(Fresnel, Schlick) {
    const Probe probe({"materials/fresnel.cl"}, R"(
kernel void reflectances(const uint count, global float* out, global const float* cosines) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float weight = schlick_weight(cosines[i]);
    const Vec3 f = schlick(vec3(0.04f, 0.5f, 1.0f), weight);
    store3(out, (int)count, (int)i, f);
}
)");
    // rounding may leave a cosine a little outside [0, 1]
    const std::vector<cl_float> cosines{0, 1e-30F, 0.1F, 0.3F, 0.5F, 0.9F, 1, 1.0000001F, -1e-7F};
    const std::size_t n = cosines.size();
    const auto out = probe.run<cl_float>("reflectances", n, 3 * n, cosines);
    const std::vector<double> f0{0.04, 0.5, 1};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = std::clamp(1.0 - cosines[i], 0.0, 1.0);
            EXPECT_NEAR(out[c * n + i], f0[c] + (1 - f0[c]) * std::pow(x, 5), 4e-7) << cosines[i];
            EXPECT_LE(out[c * n + i], 1.0F);
        }
}

}  // namespace
}  // namespace wavepath
