// A floor under smooth panes, and lights that shine on it.
#pragma once

#include "support/rendering.h"

#include <cmath>

namespace wavepath {

inline constexpr double albedo = 0.5;  // of the floor

inline Material pane(const Rgb& tint = grey(1), float transmission = 1) {
    Material material = dielectric(tint, 0);
    material.transmission = transmission;
    return material;
}

// What one pane lets through.
inline double straight(double cosine) {
    return 0.96 * (1 - std::pow(1 - cosine, 5));
}

// A floor at z = 0 under `count` panes of this normal, the lowest at z = .3.
inline Scene floor_under(int count, const Material& material, const Vec3d& normal = {0, 0, 1}) {
    Scene scene = scene_named("floor");
    add_square(scene, lambert(grey(albedo)), {0, 0, 0}, {0, 0, 1}, 2);
    for (int i = 0; i < count; ++i) add_square(scene, material, {0, 0, 0.3 + 0.05 * i}, normal, 2);
    return scene;
}

// Of the floor at the origin, seen from below the panes: light of one scattering.
inline RenderSettings at_the_floor(const char* method, uint64_t samples) {
    RenderSettings settings =
        square_settings(method, close_up({0, 0, 0}, {0, 0, 1}, 0.01, 1e-5), 16, samples);
    settings.termination = parse_termination("depth:1");
    return settings;
}

inline std::vector<PunctualLight> lights() {
    PunctualLight point;
    point.position = {0.3, 0.4, 1.2};  // 1.3 away
    point.intensity = grey(2);
    PunctualLight spot = point;
    spot.kind = LightKind::spot;
    spot.direction = {-3. / 13, -4. / 13, -12. / 13};
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = grey(3);
    sun.direction = spot.direction;
    return {point, spot, sun};
}

// Of the floor at the origin.
inline double irradiance_of(const PunctualLight& light) {
    const double cosine = 12. / 13;
    return light.kind == LightKind::directional ? 3 * cosine : 2 * cosine / (1.3 * 1.3);
}

}  // namespace wavepath
