#include "support/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace wavepath {
namespace {

const Probe& probe() {
    static const Probe instance({"sampling/vector.cl"}, R"(
// worst deviation of the frame's nine products from those of an orthonormal one, and of the way there and back
kernel void frames(const uint count, global float* out, global const float* normals) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Frame f = frame_around(vec3(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]));
    float worst = max(fabs(dot3(f.s, f.t)), max(fabs(dot3(f.t, f.n)), fabs(dot3(f.n, f.s))));
    worst = max(worst, max(fabs(dot3(f.s, f.s) - 1.0f), fabs(dot3(f.t, f.t) - 1.0f)));
    const Vec3 handed = sub3(cross3(f.s, f.t), f.n);
    worst = max(worst, sqrt(dot3(handed, handed)));
    const Vec3 v = vec3(0.48f, -0.6f, 0.64f);
    const Vec3 back = sub3(to_world(f, to_local(f, v)), v);
    worst = max(worst, sqrt(dot3(back, back)));
    out[i] = worst == worst ? worst : 1e9f;
}

kernel void products(const uint count, global float* out) {
    if (get_global_id(0) >= count) return;
    const Vec3 a = vec3(1.0f, 2.0f, 3.0f);
    const Vec3 b = vec3(-4.0f, 5.0f, 0.5f);
    out[0] = dot3(a, b);
    store3(out + 1, 1, 0, cross3(a, b));
    store3(out + 4, 1, 0, madd3(a, b, 2.0f));
    store3(out + 7, 1, 0, normalize3(vec3(0.0f, 3.0f, -4.0f)));
    out[10] = max_component3(b);
    store3(out + 11, 1, 0, select3(0, a, b));
    store3(out + 14, 1, 0, load3(out + 7, 1, 0));
}
)");
    return instance;
}

TEST(Vector, Products) {
    const auto out = probe().run<cl_float>("products", 1, 17);
    const std::vector<float> expected{7.5F,  -14.0F, -12.5F, 13.0F, -7.0F, 12.0F, 4.0F, 0.0F, 0.6F,
                                      -0.8F, 5.0F,   -4.0F,  5.0F,  0.5F,  0.0F,  0.6F, -0.8F};
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_FLOAT_EQ(out[k], expected[k]) << k;
}

// Exact: a fixed bound for every normal, the poles and their neighbourhood included.
TEST(Vector, FrameIsOrthonormal) {
    std::vector<cl_float> normals;
    const auto add = [&](double x, double y, double z) {
        const double length = std::hypot(x, y, z);
        for (const double c : {x, y, z}) normals.push_back(static_cast<cl_float>(c / length));
    };
    for (const double sign : {-1.0, 1.0}) {
        for (double tilt = 1e-12; tilt < 1; tilt *= 1.5) {
            add(tilt, 0, sign);
            add(-tilt, tilt, sign);
            add(0, -tilt, sign);
            add(1, tilt, sign * tilt);
        }
        add(0, 0, sign);
        add(1, 0, sign * 0.0);
        add(0, 1, sign * 0.0);
        add(-1, 0, sign * 0.0);
        add(-0.0, -0.0, sign);
    }
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const std::size_t count = scaled(1'000'000);
    while (normals.size() < 3 * count) {
        const double x = normal(random);
        const double y = normal(random);
        add(x, y, normal(random));
    }
    const auto worst =
        probe().run<cl_float>("frames", normals.size() / 3, normals.size() / 3, normals);
    for (std::size_t i = 0; i < worst.size(); ++i)
        ASSERT_LT(worst[i], 1e-6F)
            << normals[3 * i] << ' ' << normals[3 * i + 1] << ' ' << normals[3 * i + 2];
}

}  // namespace
}  // namespace wavepath
