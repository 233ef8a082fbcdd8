#include "prepare/light_tables.h"
#include "prepare/normalise.h"
#include "scene/scene.h"
#include "shared/params.h"
#include "support/grid.h"
#include "support/probe.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace wavepath {
namespace {

using std::numbers::pi;

// Its cells tile the quarters of the texels of a 30 x 16 map.
const Grid grid;
constexpr cl_uint width = 30;
constexpr cl_uint height = 16;
constexpr std::size_t texels = std::size_t{width} * height;

const std::string kernels = R"(
INLINE Bits2 bits_of(const uint i) {
    return independent_pair(i, 51);
}

// the square of the map, by the builtins, not the functions under test
kernel void directions(
    const uint count, global uint* out, global const EnvironmentEntry* map,
    constant const RenderParams* settings) {
    const uint i = (uint)get_global_id(0);
    const RenderParams params = *settings;
    if (i >= count) return;
    const Vec3 d = environment_sample(map, &params, bits_of(i)).wi;
    grid_count(out, atan2(d.z, d.x) * (0.5f * INV_PI_F) + 0.5f, acos(clamp(d.y, -1.0f, 1.0f)) * INV_PI_F);
}

// density and radiance towards given directions
kernel void lookups(
    const uint count, global float* out, global const EnvironmentEntry* map,
    constant const RenderParams* settings, global const float* directions) {
    const uint i = (uint)get_global_id(0);
    const RenderParams params = *settings;
    if (i >= count) return;
    const Vec3 d = load3(directions + 3 * i, 1, 0);
    const EnvironmentSample s = environment_at(map, &params, d);
    out[4 * i] = s.pdf_w;
    store3(out + 4 * i + 1, 1, 0, s.radiance);
}

// mean radiance / density over n samples an item, and how many of them have density 0 or no unit direction
kernel void fluxes(
    const uint count, global float* out, global const EnvironmentEntry* map,
    constant const RenderParams* settings, const uint n) {
    const uint i = (uint)get_global_id(0);
    const RenderParams params = *settings;
    if (i >= count) return;
    float sum = 0.0f;
    float bad = 0.0f;
    for (uint k = 0; k < n; ++k) {
        const EnvironmentSample s = environment_sample(map, &params, bits_of(i * n + k));
        bad += s.pdf_w > 0.0f && fabs(dot3(s.wi, s.wi) - 1.0f) < 2e-6f ? 0.0f : 1.0f;
        sum += s.pdf_w > 0.0f ? s.radiance.x / s.pdf_w : 0.0f;
    }
    out[2 * i] = sum / (float)n;
    out[2 * i + 1] = bad;
}
)";

const Probe& probe() {
    static const Probe instance({"lights/environment.cl"}, grid_functions(grid) + kernels);
    return instance;
}

struct Map {
    Environment environment;
    std::vector<EnvironmentEntry> entries;
    std::vector<RenderParams> params;
};

// `alone`: light points are all there is to find the map.
Map map_of(const std::vector<float>& greys, bool alone = true) {
    Map map;
    map.environment.radiance = {1, 2, 3};
    map.environment.width = width;
    map.environment.height = height;
    for (const float grey : greys)
        map.environment.pixels.insert(map.environment.pixels.end(), 3, grey);
    Scene scene;
    scene.environment = map.environment;
    const LightTables tables =
        build_light_tables(scene, NormalisedScene{}, LightChoice::power, alone);
    map.entries = tables.environment;
    RenderParams params{};
    params.environment_left = tables.environment_left;
    params.environment_width = width;
    params.environment_height = height;
    params.environment_r = 1;
    params.environment_g = 2;
    params.environment_b = 3;
    map.params = {params};
    return map;
}

Map uneven_map(bool alone = true) {
    std::mt19937 random(1);
    std::lognormal_distribution<float> radiance(0, 1.5F);
    std::vector<float> greys(texels);
    for (float& grey : greys) grey = radiance(random);
    return map_of(greys, alone);
}

// black but for one texel
Map bright_map(cl_uint column, cl_uint row) {
    std::vector<float> greys(texels);
    greys[std::size_t{row} * width + column] = 1e4F;
    return map_of(greys);
}

double texel(const Map& map, int x, int y) {
    const auto column = static_cast<std::size_t>(x + 2 * static_cast<int>(width)) % width;
    const auto row = static_cast<std::size_t>(std::clamp(y, 0, static_cast<int>(height) - 1));
    return map.environment.pixels[3 * (row * width + column)];
}

// Bilinear between texel centres at (u, v) of the map.
double radiance(const Map& map, const Point2& uv) {
    const double x = uv[0] * width - 0.5;
    const double y = uv[1] * height - 0.5;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const double fx = x - column;
    const double fy = y - row;
    return (1 - fy) * ((1 - fx) * texel(map, column, row) + fx * texel(map, column + 1, row)) +
           fy * ((1 - fx) * texel(map, column, row + 1) + fx * texel(map, column + 1, row + 1));
}

void add_direction(std::vector<cl_float>& directions, const Point2& uv) {
    const double phi = 2 * pi * (uv[0] - 0.5);
    const double theta = pi * uv[1];
    for (const double c :
         {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)})
        directions.push_back(static_cast<cl_float>(c));
}

// alpha: false_alarm over four pairs of grids; power in support/grid.h.
TEST(Environment, DirectionsFollowTheirDensity) {
    const std::vector<Point2> nodes = grid_nodes(grid);
    std::vector<cl_float> directions;
    for (const Point2& uv : nodes) add_direction(directions, uv);
    for (const Map& map : {uneven_map(), uneven_map(false), bright_map(7, 5), bright_map(0, 0)}) {
        const auto values = probe().run<cl_float>(
            "lookups", nodes.size(), 4 * nodes.size(), map.entries, map.params, directions);
        std::vector<double> densities(nodes.size());
        for (std::size_t k = 0; k < nodes.size(); ++k)
            densities[k] = values[4 * k] * 2 * pi * pi * std::sin(pi * nodes[k][1]);
        const auto probabilities = grid_probabilities(grid, densities);
        EXPECT_EQ(probabilities.back(), 0) << "the density integrates to less than 1";
        expect_distribution(
            grid,
            probe().run<cl_uint>(
                "directions", scaled(1U << 21U), grid.cells() + 1, map.entries, map.params),
            probabilities, 4);
    }
}

// What is even of a map is left to the bsdf: no light point has density where the map is darker
// than its mean all around, and a map of one brightness has none at all.
TEST(Environment, LightPointsBesideABsdfLeaveItWhatIsEven) {
    const Map uneven = uneven_map(false);
    const Map even = map_of(std::vector<float>(texels, 2.0F), false);
    EXPECT_NEAR(even.params[0].environment_left, 2, 1e-6);
    std::vector<cl_float> directions;
    std::vector<bool> dark;
    for (int y = 1; y < static_cast<int>(height); ++y) {
        for (int x = 0; x < static_cast<int>(width); ++x) {
            add_direction(directions, {(x + 1.0) / width, static_cast<double>(y) / height});
            const double brightest = std::max(
                {texel(uneven, x, y - 1), texel(uneven, x + 1, y - 1), texel(uneven, x, y),
                 texel(uneven, x + 1, y)});
            dark.push_back(brightest < static_cast<double>(uneven.params[0].environment_left));
        }
    }
    const auto lookups = [&](const Map& map) {
        return probe().run<cl_float>(
            "lookups", dark.size(), 4 * dark.size(), map.entries, map.params, directions);
    };
    const auto of_uneven = lookups(uneven);
    const auto of_even = lookups(even);
    EXPECT_GT(std::ranges::count(dark, true), 10);
    for (std::size_t k = 0; k < dark.size(); ++k) {
        EXPECT_EQ(of_uneven[4 * k] > 0, !dark[k]) << k;
        EXPECT_LT(of_even[4 * k], 1e-3F) << k;
    }
}

// Exact: bilinear values within rounding of the coordinates, wrapped in u, held at the poles.
TEST(Environment, LookupIsBilinear) {
    const Map map = uneven_map();
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(1e-4, 1 - 1e-4);
    std::vector<Point2> places{{0.5, 0.5}, {0.75, 0.5}, {1e-5, 0.3}, {1 - 1e-5, 0.3}, {0.3, 1e-4}};
    while (places.size() < 10000) {
        const double u = unit(random);
        places.push_back({u, unit(random)});
    }
    std::vector<cl_float> directions;
    for (const Point2& uv : places) add_direction(directions, uv);
    const float brightest = *std::ranges::max_element(map.environment.pixels);
    const auto values = probe().run<cl_float>(
        "lookups", places.size(), 4 * places.size(), map.entries, map.params, directions);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const double expected = radiance(map, places[k]);
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(
                values[4 * k + 1 + channel], static_cast<double>(channel + 1) * expected,
                2e-4 * brightest)
                << places[k][0] << ", " << places[k][1];
    }
}

// The integral of the radiance over the sphere; alpha: false_alarm over three means, 0.5 % found
// with probability .99.
TEST(Environment, FluxIsTheMapsIntegral) {
    constexpr std::size_t batches = 512;
    const auto n = static_cast<cl_uint>(scaled(8192));
    for (const Map& map : {uneven_map(), bright_map(7, 5), bright_map(19, 15)}) {
        // midpoints, 24 x 24 to a texel: kinks of the bilinear function fall between them
        double flux = 0;
        constexpr int fine = 24;
        for (int y = 0; y < fine * static_cast<int>(height); ++y)
            for (int x = 0; x < fine * static_cast<int>(width); ++x) {
                const Point2 uv{(x + 0.5) / (fine * width), (y + 0.5) / (fine * height)};
                flux += radiance(map, uv) * std::sin(pi * uv[1]);
            }
        flux *= 2 * pi * pi / (fine * fine * width * height);
        const auto out =
            probe().run<cl_float>("fluxes", batches, 2 * batches, map.entries, map.params, n);
        Moments moments;
        double bad = 0;
        for (std::size_t i = 0; i < batches; ++i) {
            moments.add(out[2 * i]);
            bad += out[2 * i + 1];
        }
        // rounding puts a few samples on the other side of a texel's edge
        EXPECT_LE(bad, 1 + 5e-6 * batches * n) << "samples of density 0, or not unit";
        EXPECT_TRUE(mean_is(moments, flux, 3, 0.005, 2e-4)) << "tolerance: midpoints, poles";
    }
}

TEST(Environment, ConstantEnvironmentIsUniform) {
    const Probe constant(
        {"lights/environment.cl"}, grid_functions(grid) + kernels,
        "#define HAS_ENVIRONMENT_MAP 0\n");
    const Map map = uneven_map();
    const auto out =
        constant.run<cl_float>("fluxes", 64, 128, map.entries, map.params, cl_uint{64});
    for (std::size_t i = 0; i < out.size(); i += 2) {
        EXPECT_NEAR(out[i], 4 * pi, 1e-4);
        EXPECT_EQ(out[i + 1], 0.0F);
    }
}

}  // namespace
}  // namespace wavepath
