// Where surfaces touch glass: refracting boundaries and thin walls.
#pragma once

#include "scene/bvh_builder.h"
#include "scene/normalise.h"
#include "scene/scene.h"

namespace wavepath {

// Whether some triangle lies within RAY_OFFSET before or behind glass: a glass on a table, a liquid
// in a glass, a window that closes off fog, of one mesh or of several. Says yes rather than no.
// Faces that cross at more than half a degree do not count: they are that close on a line alone;
// nor do those side by side.
bool has_contacts(const Scene& scene, const NormalisedScene& geometry, const Bvh& bvh);

}  // namespace wavepath
