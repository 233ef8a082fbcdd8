// The size of a scene.
#pragma once

#include "scene/scene.h"

namespace wavepath {

// A cube of world space: of the bounding box of all instances, its centre and longest side [m].
struct Extent {
    Vec3d centre{0, 0, 0};
    double metres = 1;
};

// Throws Error where the extent is zero or not finite.
Extent extent_of(const Scene& scene);

}  // namespace wavepath
