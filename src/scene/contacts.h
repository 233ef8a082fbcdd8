// Where surfaces touch glass: refracting boundaries and thin walls.
#pragma once

#include "scene/bvh_builder.h"
#include "scene/normalise.h"
#include "scene/scene.h"

namespace wavepath {

// Whether some triangle of another surface lies within RAY_OFFSET of glass and along it: a glass on
// a table, a liquid in a glass, a window that closes off fog. Says yes rather than no. Faces that
// cross at more than half a degree do not count: they are that close on a line alone.
bool has_contacts(const Scene& scene, const NormalisedScene& geometry, const Bvh& bvh);

}  // namespace wavepath
