#include "prepare/hidden_lights.h"

#include "prepare/device_material.h"
#include "scene/transform.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace wavepath {

namespace {

struct Ball {
    Vec3d centre;
    double radius;
};

// Around a triangle.
Ball ball_around(const NormalisedScene& geometry, std::size_t triangle) {
    Ball ball{{0, 0, 0}, 0};
    const std::array<Vec3d, 3> corners = geometry.corners_of(triangle);
    for (const Vec3d& corner : corners)
        for (std::size_t k = 0; k < 3; ++k) ball.centre[k] += corner[k] / 3;
    for (const Vec3d& corner : corners) {
        const Vec3d away = minus(corner, ball.centre);
        ball.radius = std::max(ball.radius, std::sqrt(dot(away, away)));
    }
    return ball;
}

// Whether the light falls on some of it, as far as its range and its cone say. `light`: normalised.
bool falls_on(const PunctualLight& light, const Ball& ball) {
    if (light.kind == LightKind::directional) return true;
    const Vec3d to_ball = minus(ball.centre, light.position);
    const double distance = std::sqrt(dot(to_ball, to_ball));
    if (distance <= ball.radius) return true;
    if (light.range > 0 && distance - ball.radius >= light.range) return false;
    if (light.kind == LightKind::point) return true;
    const double cosine = std::clamp(dot(to_ball, light.direction) / distance, -1.0, 1.0);
    return std::acos(cosine) - std::asin(ball.radius / distance) < light.outer_cone;
}

std::string name_of(const PunctualLight& light, std::size_t index) {
    const std::string kind = light.kind == LightKind::directional ? "sun"
                             : light.kind == LightKind::spot      ? "spot"
                                                                  : "point light";
    return light.name.empty() ? fmt::format("{} {}", kind, index)
                              : fmt::format("{} \"{}\"", kind, light.name);
}

std::string label_of(const std::string& material, uint32_t index) {
    return material.empty() ? fmt::format("material {}", index) : fmt::format("\"{}\"", material);
}

}  // namespace

std::string warning_of_hidden_lights(const Scene& scene, const NormalisedScene& geometry) {
    constexpr std::size_t most_names = 4;
    std::vector<bool> is_hidden(geometry.lights.size(), false);
    std::optional<uint32_t> glass;
    for (std::size_t t = 0; t < geometry.triangle_count() && !is_hidden.empty(); ++t) {
        const Material& material = scene.materials[geometry.materials[t]];
        if (material.boundary != Boundary::dielectric || refracts_roughly(material)) continue;
        const Ball ball = ball_around(geometry, t);
        for (std::size_t i = 0; i < is_hidden.size(); ++i) {
            const Rgb& intensity = geometry.lights[i].intensity;
            if (is_hidden[i] || *std::ranges::max_element(intensity) <= 0) continue;
            is_hidden[i] = falls_on(geometry.lights[i], ball);
            if (is_hidden[i] && !glass) glass = geometry.materials[t];
        }
    }
    if (!glass) return {};
    std::string names;
    std::size_t count = 0;
    for (std::size_t i = 0; i < is_hidden.size(); ++i)
        if (is_hidden[i] && ++count <= most_names)
            names += (count > 1 ? ", " : "") + name_of(geometry.lights[i], i);
    if (count > most_names) names += fmt::format(" and {} more", count - most_names);
    return fmt::format(
        "{}: light of {} is missing behind bodies of smooth glass ({}): a point is never found "
        "through what bends light; use lamps with an area or a sky, roughnessFactor 0.04 or more, "
        "or a thin wall without KHR_materials_volume",
        scene.name, names, label_of(scene.materials[*glass].name, *glass));
}

}  // namespace wavepath
