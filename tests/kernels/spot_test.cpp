// Spots from the host's tables through the kernel: cones from .05 to 90 degrees.
#include "prepare/light_tables.h"
#include "shared/scene.h"
#include "support/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace wavepath {
namespace {

constexpr double degree = std::numbers::pi / 180;

const Probe& probe() {
    static const Probe instance({"lights/punctual.cl"}, R"(
kernel void intensities(
    const uint count, global float* out, global const DeviceLight* light, global const float* p) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 from = vec3(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
    const LightSample s = punctual_sample(light, from);
    const Vec3 d = sub3(vec3(light->position_x, light->position_y, light->position_z), from);
    out[i] = s.radiance.x * dot3(d, d);
}
)");
    return instance;
}

// At the origin, along no axis.
PunctualLight spot_of(double inner, double outer) {
    PunctualLight light;
    light.kind = LightKind::spot;
    light.direction = {0.36, -0.48, 0.8};
    light.inner_cone = inner;
    light.outer_cone = outer;
    return light;
}

// The point at distance 0.5 and at this angle from the axis.
void append_point_at(std::vector<cl_float>& points, double angle) {
    const Vec3d axis = spot_of(0, 1).direction;
    const Vec3d across{0.8, 0.6, 0};
    for (std::size_t k = 0; k < 3; ++k)
        points.push_back(
            static_cast<cl_float>(0.5 * (std::cos(angle) * axis[k] + std::sin(angle) * across[k])));
}

std::vector<cl_float> intensities(const PunctualLight& light, const std::vector<double>& angles) {
    NormalisedScene geometry;
    geometry.lights = {light};
    const LightTables tables = build_light_tables(Scene{}, geometry, LightChoice::power, true);
    EXPECT_EQ(tables.lights.at(0).pmf, 1);
    std::vector<cl_float> points;
    for (const double angle : angles) append_point_at(points, angle);
    return probe().run<cl_float>(
        "intensities", angles.size(), angles.size(), tables.lights, points);
}

// saturate((cos - cos outer) / (cos inner - cos outer))^2 [KHR_lights_punctual], by half angles.
double falloff(double angle, double inner, double outer) {
    const auto versine = [](double x) { return std::pow(std::sin(0.5 * x), 2); };
    const double t =
        std::clamp((versine(outer) - versine(angle)) / (versine(outer) - versine(inner)), 0., 1.);
    return t * t;
}

TEST(Spot, FallsOffBetweenConesOfAllWidths) {
    for (const double outer : {0.05, 0.1, 0.5, 1., 2.5, 10., 45., 80., 90.})
        for (const double share : {0., 0.5, 0.9}) {
            std::vector<double> angles;
            for (const double at : {0., 0.1, 0.3, 0.45, 0.7, 0.89, 0.95, 1.01, 1.2})
                angles.push_back(at * outer * degree);
            const double inner = share * outer * degree;
            const auto found = intensities(spot_of(inner, outer * degree), angles);
            for (std::size_t i = 0; i < angles.size(); ++i)
                EXPECT_NEAR(found[i], falloff(angles[i], inner, outer * degree), 0.005)
                    << outer << " degrees, inner " << share << ", at " << angles[i] / degree;
        }
}

TEST(Spot, OfAHardEdgeIsWholeInsideAndNothingOutside) {
    for (const double outer : {0.05, 0.5, 5., 45., 90.})
        for (const double share : {0.999, 1.}) {
            const double edge = outer * degree;
            const auto found = intensities(
                spot_of(share * edge, edge), {0, 0.5 * edge, 0.99 * edge, 1.01 * edge, 2 * edge});
            for (const std::size_t inside : {0, 1, 2}) EXPECT_NEAR(found[inside], 1, 1e-5) << outer;
            EXPECT_EQ(found[3], 0) << outer;
            EXPECT_EQ(found[4], 0) << outer;
        }
}

}  // namespace
}  // namespace wavepath
