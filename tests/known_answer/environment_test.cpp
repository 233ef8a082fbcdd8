// Environments: constant against mapped, and the irradiance of one bright texel on tilted plates.
#include "support/rendering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double pi = std::numbers::pi;
constexpr uint32_t width = 16;
constexpr uint32_t height = 8;

Environment map_of(float value) {
    return {grey(1), width, height, std::vector<float>(std::size_t{3} * width * height, value), ""};
}

// Directions chosen all round the sphere, by area, waste half of themselves: 1 % has to do there.
Strictness strictness_of(const std::string& method) {
    return {.bias = method == "direct" ? 0.01 : 0.005, .truth_error = 1e-5};
}

RenderResult plate_under(const Environment& environment, const Vec3d& normal, const char* method) {
    Scene scene = scene_named("plate");
    add_square(scene, lambert(grey(1)), {0, 0, 0}, normal, 1);
    scene.environment = environment;
    return render_for(
        strictness_of(method), scene,
        square_settings(method, close_up({0, 0, 0}, normal, 0.1, 0.01), 16, 256));
}

TEST(Environment, ConstantLightsAWhitePlateToItsOwnRadiance) {
    for (const char* method : {"path", "bsdf", "direct", "mis"}) {
        SCOPED_TRACE(method);
        EXPECT_TRUE(has_mean(
            shared_mean(plate_under(constant_environment(1), {1, 2, 3}, method)), 1,
            strictness_of(method)));
    }
}

TEST(Environment, MapOfOnesIsTheConstant) {
    for (const char* method : {"path", "direct", "mis"}) {
        SCOPED_TRACE(method);
        EXPECT_TRUE(has_mean(
            shared_mean(plate_under(map_of(1), {1, 2, 3}, method)), 1, strictness_of(method)));
    }
}

// The bilinear lookup spreads the texel over a tent two texels wide; E / pi by the midpoint rule in
// double.
double irradiance_of_texel(uint32_t column, uint32_t row, float value, const Vec3d& normal) {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    constexpr int steps = 400;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        for (int k = 0; k < steps; ++k) {
            const double x = -1 + (i + 0.5) * 2 / steps;  // texels from the centre
            const double y = -1 + (k + 0.5) * 2 / steps;
            const double phi = 2 * pi * ((column + 0.5 + x) / width - 0.5);
            const double theta = pi * (row + 0.5 + y) / height;
            const double cosine =
                (std::sin(theta) * std::cos(phi) * normal[0] + std::cos(theta) * normal[1] +
                 std::sin(theta) * std::sin(phi) * normal[2]) /
                length;
            const double tent = (1 - std::abs(x)) * (1 - std::abs(y));
            sum += tent * std::max(cosine, 0.0) * std::sin(theta);
        }
    }
    const double cell = (2 * pi / width) * (pi / height) * (2.0 / steps) * (2.0 / steps);
    return sum * cell * value / pi;
}

TEST(Environment, OneBrightTexelLightsFromItsPlace) {
    constexpr uint32_t column = 11;
    constexpr uint32_t row = 2;
    Environment map = map_of(0);
    for (std::size_t c = 0; c < 3; ++c)
        map.pixels[3 * (std::size_t{row} * width + column) + c] = 100;
    for (const Vec3d& normal : {Vec3d{0, 1, 0}, Vec3d{-0.2, 0.5, 1}, Vec3d{1, 1, 0.5}}) {
        const double truth = irradiance_of_texel(column, row, 100, normal);
        for (const char* method : {"direct", "mis"}) {
            SCOPED_TRACE(
                fmt::format("{}, normal ({}, {}, {})", method, normal[0], normal[1], normal[2]));
            EXPECT_TRUE(has_mean(
                shared_mean(plate_under(map, normal, method)), truth, strictness_of(method)));
        }
    }
}

TEST(Environment, ScaleMultipliesTheMap) {
    Environment map = map_of(0.5F);
    map.radiance = {1, 2, 4};
    const RenderResult result = plate_under(map, {0, 1, 0}, "mis");
    EXPECT_TRUE(has_mean(shared_mean(result, "R"), 0.5));
    EXPECT_TRUE(has_mean(shared_mean(result, "G"), 1));
    EXPECT_TRUE(has_mean(shared_mean(result, "B"), 2));
}

}  // namespace
}  // namespace wavepath
