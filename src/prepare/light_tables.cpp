#include "prepare/light_tables.h"

#include "prepare/alias_table.h"
#include "prepare/texture_tables.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace wavepath {

namespace {

// Of the sphere around the unit cube: power from infinity is what falls on its disc.
constexpr double scene_radius = 0.8660254037844386;

// What of its power a light at p sends to that sphere, beside a light within: far lamps of great
// power would leave no samples to near ones.
double share_of_power(const Vec3d& p) {
    return std::min(1.0, scene_radius * scene_radius / dot(p, p));
}

double luminance(const Rgb& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

double triangle_area(const std::vector<float>& positions, std::size_t triangle) {
    const float* p = &positions[9 * triangle];
    const double u[3] = {double{p[3]} - p[0], double{p[4]} - p[1], double{p[5]} - p[2]};
    const double v[3] = {double{p[6]} - p[0], double{p[7]} - p[1], double{p[8]} - p[2]};
    return 0.5 *
           std::hypot(
               u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

// 1 - cos, right for narrow cones.
double versine(double angle) {
    return 2 * std::sin(0.5 * angle) * std::sin(0.5 * angle);
}

Vec3d middle_of(const std::vector<float>& positions, std::size_t triangle) {
    Vec3d sum{0, 0, 0};
    for (std::size_t k = 0; k < 9; ++k) sum[k % 3] += positions[9 * triangle + k] / 3;
    return sum;
}

DeviceLight punctual_light(const PunctualLight& light) {
    DeviceLight d{};
    d.kind = light.kind == LightKind::directional ? LIGHT_DIRECTIONAL : LIGHT_POINT;
    d.range = static_cast<float>(light.range);
    d.spot_outer = 3;  // 1 - cos is at most 2: everywhere
    d.spot_scale = 1;
    if (light.kind == LightKind::spot) {
        constexpr double steepest = 1e30;  // of a hard edge
        const double outer = versine(light.outer_cone);
        const double edge = outer - versine(light.inner_cone);
        d.spot_outer = static_cast<float>(outer);
        d.spot_scale = static_cast<float>(1 / std::max(edge, 1 / steepest));
    }
    d.direction_x = static_cast<float>(light.direction[0]);
    d.direction_y = static_cast<float>(light.direction[1]);
    d.direction_z = static_cast<float>(light.direction[2]);
    d.position_x = static_cast<float>(light.position[0]);
    d.position_y = static_cast<float>(light.position[1]);
    d.position_z = static_cast<float>(light.position[2]);
    d.intensity_r = light.intensity[0];
    d.intensity_g = light.intensity[1];
    d.intensity_b = light.intensity[2];
    return d;
}

double punctual_power(const PunctualLight& light) {
    switch (light.kind) {
        case LightKind::point:
            return 4 * std::numbers::pi * luminance(light.intensity);
        case LightKind::spot:
            return std::numbers::pi * (versine(light.inner_cone) + versine(light.outer_cone)) *
                   luminance(light.intensity);
        case LightKind::directional:
            return std::numbers::pi * scene_radius * scene_radius * luminance(light.intensity);
    }
    return 0;
}

EnvironmentEntry entry(const AliasRow& row) {
    EnvironmentEntry e{};
    e.alias_threshold = row.threshold;
    e.alias = row.alias;
    e.pmf = row.pmf;
    return e;
}

// Texels of a map: wrapped to the right, the last row repeated below.
class Texels {
  public:
    explicit Texels(const Environment& map) : map_(map) {}

    const float* operator()(uint32_t x, uint32_t y) const {
        const std::size_t row = std::min(y, map_.height - 1);
        return &map_.pixels[3 * (row * map_.width + x % map_.width)];
    }
    double luminance_at(uint32_t x, uint32_t y) const {
        const float* p = (*this)(x, y);
        return luminance({p[0], p[1], p[2]});
    }

  private:
    const Environment& map_;
};

// Height of a row of cells [rows of texels] times the sine in its middle.
double size_of_row(const Environment& map, uint32_t y) {
    const double top = std::max(y - 0.5, 0.0);
    const double bottom = std::min(y + 0.5, static_cast<double>(map.height));
    return (bottom - top) * std::sin(std::numbers::pi * 0.5 * (top + bottom) / map.height);
}

// Calls visit(x, y, mean over the four corners of value(x, y), size_of_row(y)) for every cell, row
// by row.
template <typename Value, typename Visit>
void for_each_cell(const Environment& map, const Value& value, const Visit& visit) {
    for (uint32_t y = 0; y <= map.height; ++y) {
        const uint32_t above = y > 0 ? y - 1 : 0;
        const double size = size_of_row(map, y);
        for (uint32_t x = 0; x < map.width; ++x)
            visit(
                x, y,
                0.25 * (value(x, above) + value(x + 1, above) + value(x, y) + value(x + 1, y)),
                size);
    }
}

// Over the sphere.
double mean_luminance(const Environment& map) {
    const Texels texels(map);
    double total = 0;
    double solid_angle = 0;
    for_each_cell(
        map, [&](uint32_t x, uint32_t y) { return texels.luminance_at(x, y); },
        [&](uint32_t, uint32_t, double mean, double size) {
            total += mean * size;
            solid_angle += size;
        });
    return total / solid_angle;
}

// Cells are chosen by what of their luminance exceeds `left`.
std::vector<EnvironmentEntry> entries_of(const Environment& map, double left) {
    const Texels texels(map);
    std::vector<std::vector<double>> weights(map.height + 1);
    std::vector<double> row_weights(map.height + 1);
    for_each_cell(
        map,
        [&](uint32_t x, uint32_t y) { return std::max(texels.luminance_at(x, y) - left, 0.0); },
        [&](uint32_t, uint32_t y, double mean, double size) {
            weights[y].push_back(mean * size);
            row_weights[y] += mean * size;
        });
    std::vector<EnvironmentEntry> entries;
    entries.reserve((std::size_t{map.width} + 1) * (map.height + 1));
    for (const AliasRow& row : build_alias_table(row_weights)) entries.push_back(entry(row));
    for (uint32_t y = 0; y <= map.height; ++y) {
        const std::vector<AliasRow> table = build_alias_table(weights[y]);
        for (uint32_t x = 0; x < map.width; ++x) {
            EnvironmentEntry e = entry(table[x]);
            e.r = texels(x, y)[0];
            e.g = texels(x, y)[1];
            e.b = texels(x, y)[2];
            entries.push_back(e);
        }
    }
    return entries;
}

// What the emission textures leave of materials' emission, by material.
class EmissionShares {
  public:
    explicit EmissionShares(const Scene& scene) : scene_(scene) {}

    // 0 where no point of the material emits.
    double of_triangle(const NormalisedScene& geometry, std::size_t triangle) {
        const uint32_t material = geometry.materials[triangle];
        if (!scene_.materials[material].has(TEXTURE_EMISSION)) return 1;
        const Texture& texture = scene_.materials[material].texture(TEXTURE_EMISSION);
        const TextureLuminance& luminance =
            known_.try_emplace(material, texture, scene_.images[*texture.image]).first->second;
        return luminance.over(&geometry.uvs[texture.uvs][6 * triangle]);
    }

  private:
    const Scene& scene_;
    std::map<uint32_t, TextureLuminance> known_;
};

DeviceLight triangle_light(const Material& material, std::size_t triangle, double area) {
    DeviceLight light{};
    light.kind = LIGHT_TRIANGLE;
    light.primitive = static_cast<uint32_t>(triangle);
    light.double_sided = material.double_sided ? 1 : 0;
    light.intensity_r = material.emission[0];
    light.intensity_g = material.emission[1];
    light.intensity_b = material.emission[2];
    light.area = static_cast<float>(area);
    return light;
}

// Lights are added to `tables` with their weights in the choice among them.
using Weights = std::vector<double>;

void add_triangle_lights(
    const Scene& scene,
    const NormalisedScene& geometry,
    LightChoice choice,
    LightTables& tables,
    Weights& weights) {
    tables.triangle_lights.assign(geometry.triangle_count(), NO_LIGHT);
    double area = 0;
    EmissionShares shares(scene);
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t) {
        const Material& material = scene.materials[geometry.materials[t]];
        if (!material.emits()) continue;
        const double share = shares.of_triangle(geometry, t);
        if (share == 0) continue;
        const DeviceLight light = triangle_light(material, t, triangle_area(geometry.positions, t));
        tables.triangle_lights[t] = static_cast<uint32_t>(tables.lights.size());
        tables.lights.push_back(light);
        const double sides = material.double_sided ? 2 : 1;
        const double power = std::numbers::pi * sides * luminance(material.emission) * share;
        const double sent = power * share_of_power(middle_of(geometry.positions, t));
        weights.push_back(light.area * (choice == LightChoice::power ? sent : 1.0));
        area += light.area;
    }
    if (choice == LightChoice::area)
        for (double& weight : weights) weight /= area;
}

void add_punctual_lights(
    const NormalisedScene& geometry, LightChoice choice, LightTables& tables, Weights& weights) {
    for (const PunctualLight& light : geometry.lights) {
        tables.lights.push_back(punctual_light(light));
        const bool is_somewhere = light.kind != LightKind::directional;
        const double share =
            geometry.is_far() && is_somewhere ? share_of_power(light.position) : 1.0;
        weights.push_back(choice == LightChoice::power ? share * punctual_power(light) : 1.0);
    }
}

void add_environment(
    const Environment& environment,
    LightChoice choice,
    bool alone,
    LightTables& tables,
    Weights& weights) {
    double mean = luminance(environment.radiance);
    if (environment.width > 0) {
        const double of_map = mean_luminance(environment);
        mean *= of_map;
        tables.environment_left = alone ? 0.0F : static_cast<float>(of_map);
        tables.environment = entries_of(environment, tables.environment_left);
    }
    if (environment.width == 0 && !alone) return;
    DeviceLight light{};
    light.kind = LIGHT_ENVIRONMENT;
    tables.lights.push_back(light);
    const double power =
        4 * std::numbers::pi * std::numbers::pi * scene_radius * scene_radius * mean;
    weights.push_back(choice == LightChoice::power ? power : 1.0);
}

}  // namespace

LightTables build_light_tables(
    const Scene& scene, const NormalisedScene& geometry, LightChoice choice, bool alone) {
    LightTables tables;
    Weights weights;
    add_triangle_lights(scene, geometry, choice, tables, weights);
    add_punctual_lights(geometry, choice, tables, weights);
    if (scene.environment) add_environment(*scene.environment, choice, alone, tables, weights);
    const std::vector<AliasRow> table = build_alias_table(weights);
    for (std::size_t i = 0; i < table.size(); ++i) {
        DeviceLight& light = tables.lights[i];
        light.alias_threshold = table[i].threshold;
        light.alias = table[i].alias;
        light.pmf = table[i].pmf;
        if (light.kind == LIGHT_ENVIRONMENT) tables.environment_pmf = light.pmf;
    }
    return tables;
}

}  // namespace wavepath
