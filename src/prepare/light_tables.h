#pragma once

#include "prepare/normalise.h"
#include "scene/scene.h"
#include "shared/scene.h"

#include <optional>
#include <vector>

namespace wavepath {

enum class LightChoice { area, power };

struct LightTables {
    std::vector<DeviceLight> lights;  // what light sampling chooses from; may be empty
    std::vector<uint32_t>
        triangle_lights;  // one a triangle: its row of `lights`, NO_LIGHT or AT_LAMP
    std::vector<EnvironmentEntry> environment;  // of a map
    float environment_pmf = 0;                  // chance that the environment is chosen
    float environment_left = 0;                 // RenderParams::environment_left
};

// `power`: by emitted power. `area`: emissive triangles by area (notes 5); they as a whole, the
// environment and each punctual light count as one light each. `alone`: no other way finds the
// environment. Else bsdf sampling finds what is even of it as well: a constant one is left out, and
// of a map the light points take only what exceeds its mean [Karlik et al. 2019].
LightTables build_light_tables(
    const Scene& scene, const NormalisedScene& geometry, LightChoice choice, bool alone);

}  // namespace wavepath
