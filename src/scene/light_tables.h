#pragma once

#include "scene/normalise.h"
#include "scene/scene.h"
#include "shared/scene.h"

#include <optional>
#include <vector>

namespace wavepath {

enum class LightChoice { area, power };

struct LightTables {
    std::vector<DeviceLight> lights;            // what light sampling chooses from; may be empty
    std::vector<uint32_t> triangle_lights;      // one a triangle: its row of `lights`, or NO_LIGHT
    std::vector<EnvironmentEntry> environment;  // of a map
    float environment_pmf = 0;                  // chance that the environment is chosen
};

// `power`: by emitted power. `area`: emissive triangles by area (notes 5); they as a whole, the
// environment and each punctual light count as one light each. `sample_constant_environment`: a
// constant environment is found by bsdf sampling as well as by any other way, so a method that
// joins both leaves it out.
LightTables build_light_tables(
    const Scene& scene,
    const NormalisedScene& geometry,
    LightChoice choice,
    bool sample_constant_environment);

}  // namespace wavepath
