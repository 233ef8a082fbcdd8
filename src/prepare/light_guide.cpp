#include "prepare/light_guide.h"

#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace wavepath {

namespace {

// Of the sphere about the lamps: 1 to 1.6 are within a tenth of each other on closelight and fog.
constexpr double margin = 1.4;
// Beyond, the cone is most of what a surface sees. Of the scene's longest side.
constexpr double largest_radius = 0.25;
// Looked at to tell whether a surface is lit: spread over a lamp, they stand for all.
constexpr std::size_t lights_looked_at = 64;

using Triangle = std::array<Vec3d, 3>;

Vec3d unit_normal(const Triangle& t) {
    return normalized(cross(minus(t[1], t[0]), minus(t[2], t[0])));
}

LightGuide sphere_about(const std::vector<Triangle>& lamps) {
    Vec3d low = lamps.front().front();
    Vec3d high = low;
    for (const Triangle& lamp : lamps) {
        for (const Vec3d& corner : lamp) {
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], corner[k]);
                high[k] = std::max(high[k], corner[k]);
            }
        }
    }
    LightGuide guide;
    for (std::size_t k = 0; k < 3; ++k) guide.centre[k] = 0.5 * (low[k] + high[k]);
    const Vec3d half = minus(high, guide.centre);
    guide.radius = margin * std::sqrt(dot(half, half));
    return guide;
}

// By the triangle's plane and its bounding box: it may find what only comes close.
bool touches(const Triangle& t, const LightGuide& guide) {
    double distance2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({t[0][k], t[1][k], t[2][k]});
        const double apart = std::max({low - guide.centre[k], guide.centre[k] - high, 0.0});
        distance2 += apart * apart;
    }
    return distance2 < guide.radius * guide.radius &&
           std::abs(dot(unit_normal(t), minus(guide.centre, t[0]))) < guide.radius;
}

}  // namespace

std::optional<LightGuide> guide_to_lights(
    const Scene& scene,
    const NormalisedScene& geometry,
    const LightTables& lights,
    const MediaTables& media) {
    std::vector<Triangle> lamps;
    std::vector<bool> both_sides;
    double chance = 0;
    for (const DeviceLight& light : lights.lights) {
        if (light.kind != LIGHT_TRIANGLE) continue;
        lamps.push_back(geometry.corners_of(light.primitive));
        both_sides.push_back(light.double_sided != 0);
        chance += light.pmf;
    }
    if (lamps.empty() || chance < 0.5) return std::nullopt;
    const LightGuide guide = sphere_about(lamps);
    if (guide.radius > largest_radius * geometry.side) return std::nullopt;

    const double extinction = extinction_around(scene, media, guide.centre);
    if (extinction > 0 && extinction * guide.radius < 1) return guide;

    const std::size_t step = lamps.size() / lights_looked_at + 1;
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t) {
        const bool opaque = scene.materials[geometry.materials[t]].boundary == Boundary::opaque;
        if (!opaque || lights.triangle_lights[t] != NO_LIGHT) continue;
        const Triangle triangle = geometry.corners_of(t);
        if (!touches(triangle, guide)) continue;
        for (std::size_t i = 0; i < lamps.size(); i += step) {
            const Vec3d normal = unit_normal(lamps[i]);
            for (const Vec3d& corner : triangle) {
                const double height = dot(normal, minus(corner, lamps[i][0]));
                if ((both_sides[i] ? std::abs(height) : height) > 0.01 * guide.radius) return guide;
            }
        }
    }
    return std::nullopt;
}

}  // namespace wavepath
