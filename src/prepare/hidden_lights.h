// Punctual lights that smooth glass hides: nothing finds a point through a body that bends light.
#pragma once

#include "prepare/normalise.h"
#include "scene/scene.h"

#include <string>

namespace wavepath {

// A line that names the punctual lights whose light falls on the smooth faces of bodies of glass,
// behind which it will be missing; empty where there is none.
std::string warning_of_hidden_lights(const Scene& scene, const NormalisedScene& geometry);

}  // namespace wavepath
