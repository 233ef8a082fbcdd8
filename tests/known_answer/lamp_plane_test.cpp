// Surfaces in the plane of a lamp, or within 2^-20 of it: what shines is seen, by chance and by
// connections alike, in any order of the file.
#include "support/rendering.h"

#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double extent = 4;  // of the scenes [m]
// Of a square lamp of side 1 and radiance 1, where a floor 1 m below has its middle (S3).
constexpr double irradiance = 0.7522746884541075;

struct Square {
    Material material;
    double height;  // along the axis
    double side;
    bool faces_up = false;
};

// Squares on one axis through their middles.
Scene stack_of(const std::vector<Square>& squares, const Vec3d& axis, bool is_reversed) {
    Scene scene = scene_named("stack");
    const Vec3d up = normalized(axis);
    std::vector<Square> order = squares;
    if (is_reversed) std::reverse(order.begin(), order.end());
    for (const Square& s : order) {
        const double facing = s.faces_up ? 1 : -1;
        add_square(
            scene, s.material, {up[0] * s.height, up[1] * s.height, up[2] * s.height},
            {up[0] * facing, up[1] * facing, up[2] * facing}, s.side);
    }
    return scene;
}

// Light of one scattering that the middle of the square at `height` sends up, or down.
RenderSettings settings_at(
    const char* method, const Vec3d& axis, double height, bool from_above = true) {
    const Vec3d up = normalized(axis);
    const double side = from_above ? 1 : -1;
    const Camera camera = close_up(
        {up[0] * height, up[1] * height, up[2] * height},
        {up[0] * side, up[1] * side, up[2] * side}, 0.2, 2e-3);
    RenderSettings settings = square_settings(method, camera, 16, 256);
    settings.termination = parse_termination("depth:1");
    return settings;
}

Material lamp(float radiance, bool double_sided = false) {
    return lambert(grey(0), grey(radiance), double_sided);
}

const Material white = lambert(grey(1));
const Material black = lambert(grey(0));
const Vec3d level{0, 0, 1};
const Vec3d tilted{1, 2, 2};
constexpr const char* three_methods[] = {"path", "direct", "mis"};

// What a floor 1 m below the lamp at height 1 shows.
void expect_radiance(
    const std::vector<Square>& squares,
    const Vec3d& axis,
    double truth_in_order,
    double truth_reversed,
    const Strictness& strictness) {
    for (const bool is_reversed : {false, true})
        for (const char* method : three_methods)
            EXPECT_TRUE(has_mean(
                shared_mean(render_for(
                    strictness, stack_of(squares, axis, is_reversed),
                    settings_at(method, axis, 0))),
                is_reversed ? truth_reversed : truth_in_order, strictness))
                << method << (is_reversed ? ", reversed" : "");
}

const Square floor_below{white, 0, 0.02, true};
// S3's point is one; the camera sees a square of 2 mm.
constexpr double footprint = 1e-5;

TEST(LampPlane, OfACeiling) {
    const Strictness strictness{.bias = .01, .tests = 60, .truth_error = footprint};
    for (const double gap : {0., 1e-7, -1e-7, 5e-7, -5e-7})
        for (const bool faces_up : {false, true}) {
            SCOPED_TRACE(
                fmt::format("gap {}, the ceiling faces {}", gap, faces_up ? "up" : "down"));
            expect_radiance(
                {{lamp(1), 1, 1}, {black, 1 + gap * extent, extent, faces_up}, floor_below},
                faces_up ? tilted : level, irradiance / pi, irradiance / pi, strictness);
        }
}

// A card over the middle of the lamp, and one farther off than 2^-20.
TEST(LampPlane, OfACard) {
    const Strictness strictness{.bias = .01, .tests = 30, .truth_error = footprint};
    const Square far_off{black, -1, extent};  // makes the scene as large as the others
    for (const double gap : {0., 5e-7, -5e-7})
        expect_radiance(
            {{lamp(1), 1, 1}, {black, 1 + gap * extent, .5}, floor_below, far_off}, level,
            irradiance / pi, irradiance / pi, strictness);
    // E / pi of the card's square: two right-angled halves of Lambert's formula
    const double half = .25;
    const double cosine = half / std::sqrt(1 + half * half);
    const double hidden = 4 * cosine * std::atan(cosine) / pi;
    expect_radiance(
        {{lamp(1), 1, 1}, {black, 1 - 2e-5, .5}, floor_below, far_off}, level,
        irradiance / pi - hidden, irradiance / pi - hidden, {.bias = .01, .truth_error = 1e-4});
}

// Each side shows its own lamp.
TEST(LampPlane, OfLampsBackToBack) {
    const Strictness strictness{.bias = .01, .tests = 24, .truth_error = footprint};
    for (const double gap : {0., 5e-7, -5e-7}) {
        const std::vector<Square> squares{
            {lamp(1), 1, 1},
            {lamp(3), 1 + gap * extent, 1, true},
            floor_below,
            {white, 2, 0.02},
            {black, -1, extent}};
        SCOPED_TRACE(gap);
        expect_radiance(squares, level, irradiance / pi, irradiance / pi, strictness);
        for (const bool is_reversed : {false, true})
            for (const char* method : three_methods)
                EXPECT_TRUE(has_mean(
                    shared_mean(render_for(
                        strictness, stack_of(squares, level, is_reversed),
                        settings_at(method, level, 2, false))),
                    3 * irradiance / pi, strictness))
                    << method << (is_reversed ? ", reversed" : "");
    }
}

// Of two that shine to one side the first of the file; the other shows beside it.
TEST(LampPlane, OfTwoLampsTheFirstShows) {
    const Strictness strictness{.bias = .01, .tests = 24, .truth_error = footprint};
    const double half = .25;
    const double cosine = half / std::sqrt(1 + half * half);
    const double of_small = 4 * cosine * std::atan(cosine) / pi;
    for (const double gap : {0., 5e-7, -5e-7})
        for (const bool double_sided : {false, true}) {
            SCOPED_TRACE(fmt::format("gap {}, double-sided {}", gap, double_sided));
            expect_radiance(
                {{lamp(4), 1, .5},
                 {lamp(1, double_sided), 1 + gap * extent, 1},
                 floor_below,
                 {black, -1, extent}},
                double_sided ? tilted : level, irradiance / pi + 3 * of_small, irradiance / pi,
                strictness);
        }
}

// All methods, seen from farther off.
TEST(LampPlane, IsTheSameInEveryMethod) {
    const std::vector<Square> squares{
        {black, 1, extent}, {lamp(1), 1, 1}, {lamp(2), 1 + 2e-7, 1, true}, {white, 0, 2, true}};
    const Scene scene = stack_of(squares, tilted, false);
    const Strictness strictness{.bias = .01, .tests = 10, .truth_error = footprint};
    for (const char* method : {"path", "bsdf", "direct", "direct-bsdf", "mis"}) {
        Camera camera = close_up({0, 0, 0}, {1.5, 2, 2}, .5, 2e-3);
        RenderSettings settings = square_settings(method, camera, 16, 256);
        settings.termination = parse_termination("depth:1");
        EXPECT_TRUE(has_mean(
            shared_mean(render_for(strictness, scene, settings)), irradiance / pi, strictness))
            << method;
    }
}

}  // namespace
}  // namespace wavepath
