#include "shared/path.h"
#include "shared/scene.h"
#include "support/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wavepath {
namespace {

const Probe& probe() {
    static const Probe instance({"lights/punctual.cl"}, R"(
// p, wi, radiance, pdf_w at points on the plane z = 0
kernel void connections(
    const uint count, global float* out, global const DeviceLight* light, global const float* xy) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const LightSample s = punctual_sample(light, vec3(xy[2 * i], xy[2 * i + 1], 0.0f));
    store3(out + 10 * i, 1, 0, s.p);
    store3(out + 10 * i + 3, 1, 0, s.wi);
    store3(out + 10 * i + 6, 1, 0, s.radiance);
    out[10 * i + 9] = s.pdf_w;
}
)");
    return instance;
}

// At (0, 0, 0.5), shining down, rgb (1, 2, 3), chosen with chance 1/4.
DeviceLight light_of(cl_uint kind) {
    DeviceLight light{};
    light.kind = kind;
    light.pmf = 0.25F;
    light.spot_outer = 3;
    light.spot_scale = 1;
    light.position_z = 0.5F;
    light.direction_z = -1;
    light.intensity_r = 1;
    light.intensity_g = 2;
    light.intensity_b = 3;
    return light;
}

// Radiance of channel r at (x, 0, 0), after a check of everything else.
double radiance_at(const DeviceLight& light, float x) {
    const auto out = probe().run<cl_float>(
        "connections", 1, 10, std::vector<DeviceLight>{light}, std::vector<cl_float>{x, 0});
    EXPECT_EQ(out[9], PDF_CERTAIN);
    EXPECT_NEAR(std::hypot(out[3], out[4], out[5]), 1, 2e-7);
    EXPECT_FLOAT_EQ(out[7], 2 * out[6]);
    EXPECT_FLOAT_EQ(out[8], 3 * out[6]);
    if (light.kind == LIGHT_DIRECTIONAL) {
        EXPECT_EQ(out[5], 1);
        EXPECT_GT(out[2], 1) << "outside the normalised scene";
    } else {
        EXPECT_NEAR(out[0], 0, 1e-6);
        EXPECT_NEAR(out[2], 0.5, 1e-6);
    }
    return out[6];
}

// I / d^2, divided by the chance of the choice.
TEST(Punctual, PointFallsOffWithTheSquare) {
    const DeviceLight light = light_of(LIGHT_POINT);
    for (const float x : {0.0F, 0.1F, 0.5F, 2.0F})
        EXPECT_NEAR(radiance_at(light, x) * 0.25 * (double{x} * x + 0.25), 1, 1e-6) << x;
}

// KHR_lights_punctual: range window saturate(1 - (d / range)^4).
TEST(Punctual, RangeEnds) {
    DeviceLight light = light_of(LIGHT_POINT);
    light.range = 1;
    for (const float x : {0.0F, 0.5F, 0.8F}) {
        const double d2 = double{x} * x + 0.25;
        EXPECT_NEAR(radiance_at(light, x), 4 / d2 * (1 - d2 * d2), 1e-5) << x;
    }
    EXPECT_EQ(radiance_at(light, 0.9F), 0);
}

// The extension's falloff: squared, from 1 within the inner to 0 beyond the outer cone.
TEST(Punctual, SpotFallsOffBetweenItsCones) {
    DeviceLight light = light_of(LIGHT_POINT);
    const double inner = std::cos(0.3);
    const double outer = std::cos(0.6);
    light.spot_outer = static_cast<float>(1 - outer);
    light.spot_scale = static_cast<float>(1 / (inner - outer));
    for (const double angle : {0.0, 0.2, 0.29, 0.4, 0.5, 0.59, 0.61, 1.2}) {
        const double x = 0.5 * std::tan(angle);
        const double cone = std::fmin(1, std::fmax(0, (std::cos(angle) - outer) / (inner - outer)));
        EXPECT_NEAR(
            radiance_at(light, static_cast<float>(x)), 4 * cone * cone / (x * x + 0.25), 2e-5)
            << angle;
    }
}

TEST(Punctual, DirectionalIsTheSameEverywhere) {
    const DeviceLight light = light_of(LIGHT_DIRECTIONAL);
    for (const float x : {0.0F, 0.5F})
        EXPECT_FLOAT_EQ(static_cast<float>(radiance_at(light, x)), 4);
}

TEST(Punctual, LightAtThePointItselfGivesNothing) {
    DeviceLight light = light_of(LIGHT_POINT);
    light.position_z = 0;
    const auto out = probe().run<cl_float>(
        "connections", 1, 10, std::vector<DeviceLight>{light}, std::vector<cl_float>{0, 0});
    EXPECT_EQ(out[6], 0.0F);
}

}  // namespace
}  // namespace wavepath
