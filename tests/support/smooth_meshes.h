// Bodies as modellers make them, and their vertex normals.
#pragma once

#include "support/scenes.h"

#include <utility>
#include <vector>

namespace wavepath {

// Normals as of "shade smooth": at each place the mean of the faces that meet there, by area.
void shade_smooth(Primitive& primitive);

// A closed curve (radius, height) turned about the y axis in `steps` steps; it runs upwards on the
// outside. Triangles without area, at radius 0, are left out.
Primitive& add_lathed(
    Scene& scene,
    const Material& material,
    const std::vector<std::pair<double, double>>& curve,
    unsigned steps);

}  // namespace wavepath
