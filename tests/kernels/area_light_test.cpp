#include "shared/scene.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace wavepath {
namespace {

using std::numbers::pi;

constexpr std::size_t batches = 512;

const std::string kernels = R"(
// Over n samples an item: means of 1 / pdf_w [sr], of L cos / pdf_w and of its square; worst error of area_light_pdf_w.
// place: point, unit normal. Lights lie in the plane z = 1.
kernel void light_samples(
    const uint count, global float* out, global const float* triangles,
    global const DeviceLight* lights,
    const uint light_count, global const float* place, const uint n) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Vec3 from = load3(place, 1, 0);
    const Vec3 normal = load3(place + 3, 1, 0);
    float solid_angle = 0.0f;
    float sum = 0.0f;
    float squares = 0.0f;
    float worst = 0.0f;
    for (uint k = 0; k < n; ++k) {
        const Sample2 u = unit_pair(independent_pair(i * n + k, 61));
        const uint chosen = choose_light(lights, light_count, independent_pair(i * n + k, 62).u);
        const LightSample s = area_light_sample(triangles, lights + chosen, from, u);
        const float cosine = dot3(s.wi, normal);
        const float value = s.radiance.x * (cosine < 0.0f ? 0.0f : cosine);  // NaN passes
        solid_angle += s.radiance.x;
        sum += value;
        squares += value * value;
        const float distance = (1.0f - from.z) / s.wi.z;
        const float again = area_light_pdf_w(triangles + TRIANGLE_FLOATS * chosen, lights + chosen, from, distance * distance, fabs(s.wi.z));
        worst = max(worst, fabs(again / s.pdf_w - 1.0f));
    }
    out[4 * i] = solid_angle / (float)n;
    out[4 * i + 1] = sum / (float)n;
    out[4 * i + 2] = squares / (float)n;
    out[4 * i + 3] = worst;
}
)";

enum class Sampling { by_area, by_solid_angle };

const Probe& probe(Sampling sampling) {
    const auto built = [](const std::string& by_solid_angle) {
        return Probe(
            {"lights/area_light.cl"}, kernels,
            "#define HAS_VERTEX_NORMALS 0\n#define HAS_VERTEX_COLORS 0\n#define UV_SETS 0\n"
            "#define HAS_NORMAL_MAPS 0\n#define HAS_VERTEX_ALPHAS 0\n"
            "#define LIGHTS_BY_SOLID_ANGLE " +
                by_solid_angle + "\n");
    };
    static const Probe by_area = built("0");
    static const Probe by_solid_angle = built("1");
    return sampling == Sampling::by_area ? by_area : by_solid_angle;
}

using Corner = std::array<float, 2>;  // in the plane z = 1

// Triangles of radiance 1 that shine down, chosen with the given chances.
struct Lights {
    std::vector<cl_float> triangles;
    std::vector<DeviceLight> lights;

    void add(const std::array<Corner, 3>& clockwise, float pmf) {
        const auto [a, b, c] = clockwise;
        DeviceLight light{};
        light.kind = LIGHT_TRIANGLE;
        light.primitive = static_cast<cl_uint>(lights.size());
        light.pmf = pmf;
        light.area = 0.5F * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        // two lights at most: an alias table by hand
        light.alias_threshold = lights.empty() ? 1.0F : 2 * pmf;
        if (!lights.empty()) lights.front().alias_threshold = 1.0F;
        light.alias = 0;
        light.intensity_r = 1;
        triangles.insert(
            triangles.end(), {std::bit_cast<float>(0U), std::bit_cast<float>(light.primitive), a[0],
                              a[1], 1, b[0], b[1], 1, c[0], c[1], 1, 0});
        lights.push_back(light);
    }
};

// The unit square as two triangles, the second chosen with chance `pmf` <= 1/2.
Lights square(float pmf) {
    Lights lights;
    lights.add({Corner{-0.5F, -0.5F}, Corner{-0.5F, 0.5F}, Corner{0.5F, 0.5F}}, 1 - pmf);
    lights.add({Corner{-0.5F, -0.5F}, Corner{0.5F, 0.5F}, Corner{0.5F, -0.5F}}, pmf);
    return lights;
}

Lights triangle() {
    Lights lights;
    lights.add({Corner{0, 0}, Corner{0, 1}, Corner{1, 0}}, 1);
    return lights;
}

struct Estimates {
    Moments solid_angle, irradiance, square;
    float worst_pdf_error = 0;  // relative, of area_light_pdf_w against the sample's
};

Estimates estimate(
    const Lights& lights,
    std::array<double, 3> p,
    std::array<double, 3> n,
    std::size_t samples,
    Sampling sampling = Sampling::by_area) {
    std::vector<cl_float> place(6);
    for (std::size_t c = 0; c < 3; ++c) {
        place[c] = static_cast<cl_float>(p[c]);
        place[3 + c] = static_cast<cl_float>(n[c] / std::hypot(n[0], n[1], n[2]));
    }
    const auto out = probe(sampling).run<cl_float>(
        "light_samples", batches, 4 * batches, lights.triangles, lights.lights,
        static_cast<cl_uint>(lights.lights.size()), place,
        static_cast<cl_uint>(scaled(samples / batches)));
    Estimates e;
    for (std::size_t i = 0; i < batches; ++i) {
        e.solid_angle.add(out[4 * i]);
        e.irradiance.add(out[4 * i + 1]);
        e.square.add(out[4 * i + 2]);
        e.worst_pdf_error = std::max(e.worst_pdf_error, out[4 * i + 3]);
    }
    return e;
}

// Lambert's formula for polygons. alpha: false_alarm over 12 means, each finds 0.5 % with
// probability .99.
TEST(AreaLight, IrradianceAndSolidAngle) {
    struct Row {
        std::array<double, 3> p, n;
        double irradiance, solid_angle;  // 0: not tabulated
    };
    const std::vector<Row> rows{
        {{0, 0, 0}, {0, 0, 1}, 0.7522746884541075, 0.80543168316132},
        {{0.5, 0, 0}, {0, 0, 1}, 0.5666451120495073, 0.64350110879328},
        {{2, 1, 0}, {0, 0, 1}, 0.03023651582530077, 0.07123064673744},
        {{0, 0, 0}, {1, 0, 1}, 0.5319385335208968, 0.80543168316132},
        {{0.2, 0.1, 0.3}, {0, 1, 1}, 0.732156927081709, 0}};
    for (const Row& row : rows) {
        const Estimates e = estimate(square(0.3F), row.p, row.n, 1U << 21U);
        EXPECT_LT(e.worst_pdf_error, 1e-5F);
        EXPECT_TRUE(mean_is(e.irradiance, row.irradiance, 12, 0.005))
            << row.p[0] << ", " << row.p[1];
        EXPECT_TRUE(row.solid_angle == 0 || mean_is(e.solid_angle, row.solid_angle, 12, 0.005))
            << row.p[0] << ", " << row.p[1];
    }
    const Estimates e = estimate(triangle(), {0, 0, 0}, {0, 0, 1}, 1U << 21U);
    EXPECT_TRUE(mean_is(e.irradiance, 0.3022998940390363, 12, 0.005));
    EXPECT_TRUE(mean_is(
        estimate(triangle(), {1, 1, 0}, {0, 0, 1}, 1U << 21U).irradiance, 0.1329099816445153, 12,
        0.005));
}

// What a polygon of the plane z = 1 and of radiance 1 brings to a horizontal surface (Lambert
// 1760).
double irradiance_of(const std::vector<Corner>& polygon, std::array<double, 3> p) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto [x0, y0] = polygon[i];
        const auto [x1, y1] = polygon[(i + 1) % polygon.size()];
        const std::array a{x0 - p[0], y0 - p[1], 1 - p[2]};
        const std::array b{x1 - p[0], y1 - p[1], 1 - p[2]};
        const double normal_x = a[1] * b[2] - a[2] * b[1];
        const double normal_y = a[2] * b[0] - a[0] * b[2];
        const double normal_z = a[0] * b[1] - a[1] * b[0];
        const double sine = std::hypot(normal_x, normal_y, normal_z);
        const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        sum += std::atan2(sine, cosine) * normal_z / sine;
    }
    return std::abs(sum) / 2;
}

// Of a triangle of the plane z = 1 (Van Oosterom and Strackee 1983, eq. 8)
double solid_angle_of(const std::array<Corner, 3>& triangle, std::array<double, 3> p) {
    std::array<std::array<double, 3>, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) {
        r[i] = {triangle[i][0] - p[0], triangle[i][1] - p[1], 1 - p[2]};
        const double length = std::hypot(r[i][0], r[i][1], r[i][2]);
        for (double& x : r[i]) x /= length;
    }
    const auto dot = [&](std::size_t i, std::size_t k) {
        return r[i][0] * r[k][0] + r[i][1] * r[k][1] + r[i][2] * r[k][2];
    };
    const double volume = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) +
                          r[0][1] * (r[1][2] * r[2][0] - r[1][0] * r[2][2]) +
                          r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    return 2 * std::atan2(std::abs(volume), 1 + dot(0, 1) + dot(1, 2) + dot(2, 0));
}

// From the middle of a lamp to beyond its corners, from 1/50 of its size away to twice its size.
// alpha: false_alarm over all means, each finds 0.5 % with probability .99.
TEST(AreaLight, BySolidAngleMeansAreThoseOfLambertAndOneTriangleHasNoVariance) {
    const std::array<Corner, 3> corners{Corner{0, 0}, Corner{0.1F, 1}, Corner{1, 0.3F}};
    Lights one;
    one.add(corners, 1);
    std::vector<std::array<double, 3>> places;
    for (const double z : {0.98, 0.9, 0.5, -1.0})
        for (const auto& [x, y] :
             {std::pair{0.4, 0.4}, std::pair{0.0, 0.0}, std::pair{1.2, 0.3}, std::pair{-0.3, 0.8}})
            places.push_back({x, y, z});
    for (const auto& p : places) {
        SCOPED_TRACE(testing::Message() << p[0] << ", " << p[1] << ", " << p[2]);
        const Estimates e = estimate(one, p, {0, 0, 1}, 1U << 21U, Sampling::by_solid_angle);
        EXPECT_TRUE(mean_is(
            e.irradiance, irradiance_of({corners.begin(), corners.end()}, p), 2 * places.size(),
            0.005));
        EXPECT_LT(e.worst_pdf_error, 1e-4F);  // from close to the plane the test's own distance
        EXPECT_NEAR(e.solid_angle.mean() / solid_angle_of(corners, p), 1, 1e-4);
        EXPECT_LT(e.solid_angle.variance(), 1e-10);
        EXPECT_TRUE(mean_is(
            estimate(square(0.3F), p, {0, 0, 1}, 3U << 20U, Sampling::by_solid_angle).irradiance,
            irradiance_of(
                {Corner{-0.5F, -0.5F}, Corner{-0.5F, 0.5F}, Corner{0.5F, 0.5F},
                 Corner{0.5F, -0.5F}},
                p),
            2 * places.size(), 0.005));
    }
}

// Near a corner, a side, the plane and within it: what is not seen well is sampled by area.
TEST(AreaLight, BySolidAngleIsANumberNextToTheLamp) {
    for (const double z : {1.0, 1 - 1e-7, 1 - 1e-5, 1 - 1e-3})
        for (const auto& [x, y] :
             {std::pair{0.2, 0.2}, std::pair{0.0, 0.0}, std::pair{0.5, 0.0}, std::pair{2.0, 3.0}}) {
            const Estimates e =
                estimate(triangle(), {x, y, z}, {0, 0, 1}, 1U << 14U, Sampling::by_solid_angle);
            EXPECT_TRUE(std::isfinite(e.irradiance.mean())) << x << ", " << y << ", " << z;
            EXPECT_TRUE(std::isfinite(e.solid_angle.mean())) << x << ", " << y << ", " << z;
        }
    for (const float size : {1e-5F, 1e-6F, 1e-8F}) {
        Lights tiny;
        tiny.add({Corner{0, 0}, Corner{0, size}, Corner{size, 0}}, 1);
        const Estimates e = estimate(
            tiny, {0.2 * size, 0.3 * size, 1 - std::max(0.5 * size, 6e-8)}, {0, 0, 1}, 1U << 14U,
            Sampling::by_solid_angle);
        EXPECT_TRUE(std::isfinite(e.irradiance.mean())) << "size " << size;
    }
}

TEST(AreaLight, BackIsDarkUnlessDoubleSided) {
    Lights lights = square(0.5F);
    EXPECT_EQ(estimate(lights, {0, 0, 2}, {0, 0, -1}, batches).irradiance.mean(), 0);
    for (DeviceLight& light : lights.lights) light.double_sided = 1;
    const Estimates e = estimate(lights, {0, 0, 2}, {0, 0, -1}, 1U << 18U);
    EXPECT_TRUE(mean_is(e.irradiance, 0.7522746884541075, 1));
}

// Relative variance A int G^2 dA / (int G dA)^2 - 1 of uniform area sampling, by its second moment.
// alpha: false_alarm over 3; a 10 % change of the variance is found with probability .99.
TEST(AreaLight, VarianceOfAreaSampling) {
    struct Row {
        std::array<double, 3> p;
        double form_factor, variance;
    };
    const std::vector<Row> rows{
        {{0, 0, 0}, 0.2394564704607735, 0.0303545},
        {{0.5, 0.5, 0}, 0.1385316059948930, 0.255292},
        {{0, 0, 0.9}, 0.96833955697404, 10.3151}};
    for (const Row& row : rows) {
        const Estimates e = estimate(square(0.5F), row.p, {0, 0, 1}, 1U << 21U);
        const double mean = pi * row.form_factor;
        EXPECT_TRUE(mean_is(
            e.square, (1 + row.variance) * mean * mean, 3, 0.1 * row.variance / (1 + row.variance),
            2e-5))
            << row.p[0] << ", " << row.p[2];
    }
}

}  // namespace
}  // namespace wavepath
