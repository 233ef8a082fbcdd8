#include "scene/light_tables.h"

#include "scene/alias_table.h"
#include "scene/texture_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace wavepath {

namespace {

// Of the sphere around the normalised bounding box: power from infinity is what falls on its disc.
constexpr double scene_radius = 0.8660254037844386;

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

DeviceLight punctual_light(const PunctualLight& light) {
    DeviceLight d{};
    d.kind = light.kind == LightKind::directional ? LIGHT_DIRECTIONAL : LIGHT_POINT;
    d.range = static_cast<float>(light.range);
    d.spot_offset = 1;
    if (light.kind == LightKind::spot) {
        const double inner = std::cos(light.inner_cone);
        const double outer = std::cos(light.outer_cone);
        d.spot_scale = static_cast<float>(1 / std::max(1e-3, inner - outer));
        d.spot_offset = static_cast<float>(-outer) * d.spot_scale;
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
            return 2 * std::numbers::pi *
                   (1 - 0.5 * (std::cos(light.inner_cone) + std::cos(light.outer_cone))) *
                   luminance(light.intensity);
        case LightKind::directional:
            return std::numbers::pi * scene_radius * scene_radius * luminance(light.intensity);
    }
    return 0;
}

// Luminance of a texel, averaged over its square as the bilinear lookup sees it: positive wherever
// the lookup is.
double texel_weight(const Environment& map, uint32_t x, uint32_t y) {
    constexpr double tent[3] = {0.125, 0.75, 0.125};
    double sum = 0;
    for (int dy = -1; dy <= 1; ++dy) {
        const auto row = static_cast<uint32_t>(
            std::clamp(static_cast<int>(y) + dy, 0, static_cast<int>(map.height) - 1));
        for (int dx = -1; dx <= 1; ++dx) {
            const uint32_t column = (x + map.width + static_cast<uint32_t>(dx + 1) - 1) % map.width;
            const float* texel = &map.pixels[3 * (std::size_t{row} * map.width + column)];
            sum += tent[dx + 1] * tent[dy + 1] * luminance({texel[0], texel[1], texel[2]});
        }
    }
    return sum;
}

EnvironmentEntry entry(const AliasRow& row) {
    EnvironmentEntry e{};
    e.alias_threshold = row.threshold;
    e.alias = row.alias;
    e.pmf = row.pmf;
    return e;
}

// Rows first, then texels row by row; returns the mean luminance over the sphere.
double append_map(std::vector<EnvironmentEntry>& entries, const Environment& map) {
    std::vector<double> row_weights(map.height);
    std::vector<EnvironmentEntry> texels;
    texels.reserve(std::size_t{map.width} * map.height);
    double solid_angles = 0;
    double total = 0;
    for (uint32_t y = 0; y < map.height; ++y) {
        const double sine = std::sin(std::numbers::pi * (y + 0.5) / map.height);
        std::vector<double> weights(map.width);
        for (uint32_t x = 0; x < map.width; ++x) {
            weights[x] = texel_weight(map, x, y) * sine;
            row_weights[y] += weights[x];
        }
        const std::vector<AliasRow> table = build_alias_table(weights);
        for (uint32_t x = 0; x < map.width; ++x) {
            EnvironmentEntry e = entry(table[x]);
            const float* texel = &map.pixels[3 * (std::size_t{y} * map.width + x)];
            e.r = texel[0];
            e.g = texel[1];
            e.b = texel[2];
            texels.push_back(e);
        }
        total += row_weights[y];
        solid_angles += sine * map.width;
    }
    for (const AliasRow& row : build_alias_table(row_weights)) entries.push_back(entry(row));
    entries.insert(entries.end(), texels.begin(), texels.end());
    return total / solid_angles;
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

}  // namespace

LightTables build_light_tables(
    const Scene& scene,
    const NormalisedScene& geometry,
    LightChoice choice,
    bool sample_constant_environment) {
    LightTables tables;
    std::vector<double> weights;
    tables.triangle_lights.assign(geometry.triangle_count(), NO_LIGHT);
    double area = 0;
    EmissionShares shares(scene);
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t) {
        const Material& material = scene.materials[geometry.materials[t]];
        if (!material.emits()) continue;
        const double share = shares.of_triangle(geometry, t);
        if (share == 0) continue;
        DeviceLight light{};
        light.kind = LIGHT_TRIANGLE;
        light.primitive = static_cast<cl_uint>(t);
        light.double_sided = material.double_sided ? 1 : 0;
        light.intensity_r = material.emission[0];
        light.intensity_g = material.emission[1];
        light.intensity_b = material.emission[2];
        light.area = static_cast<float>(triangle_area(geometry.positions, t));
        tables.triangle_lights[t] = static_cast<uint32_t>(tables.lights.size());
        tables.lights.push_back(light);
        const double sides = material.double_sided ? 2 : 1;
        const double power = std::numbers::pi * sides * luminance(material.emission) * share;
        weights.push_back(light.area * (choice == LightChoice::power ? power : 1.0));
        area += light.area;
    }
    if (choice == LightChoice::area)
        for (double& weight : weights) weight /= area;

    for (const PunctualLight& light : geometry.lights) {
        tables.lights.push_back(punctual_light(light));
        weights.push_back(choice == LightChoice::power ? punctual_power(light) : 1.0);
    }
    if (scene.environment) {
        const Environment& environment = *scene.environment;
        double mean = luminance(environment.radiance);
        if (environment.width > 0) mean *= append_map(tables.environment, environment);
        if (environment.width > 0 || sample_constant_environment) {
            DeviceLight light{};
            light.kind = LIGHT_ENVIRONMENT;
            tables.lights.push_back(light);
            const double power =
                4 * std::numbers::pi * std::numbers::pi * scene_radius * scene_radius * mean;
            weights.push_back(choice == LightChoice::power ? power : 1.0);
        }
    }

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
