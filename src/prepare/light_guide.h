// Where light is concentrated round the lamps, for directions to be aimed at.
#pragma once

#include "prepare/light_tables.h"
#include "prepare/media_tables.h"
#include "prepare/normalise.h"
#include "scene/scene.h"

#include <optional>

namespace wavepath {

// [normalised]
struct LightGuide {
    Vec3d centre{0, 0, 0};
    double radius = 0;
};

// A sphere about all emissive triangles and what lies close to them (kernels/lights/guide.cl),
// where something there shines brightly: a surface that they light, or a medium that scatters and
// is not so dense that directions are soon forgotten. Nothing where the lamps are too far apart to
// be aimed at together, or other light is stronger.
std::optional<LightGuide> guide_to_lights(
    const Scene& scene,
    const NormalisedScene& geometry,
    const LightTables& lights,
    const MediaTables& media);

}  // namespace wavepath
