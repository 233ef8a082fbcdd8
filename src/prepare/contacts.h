// Where surfaces touch glass, which are refracting boundaries and thin walls, or lamps.
#pragma once

#include "prepare/bvh_builder.h"
#include "prepare/normalise.h"
#include "scene/scene.h"

#include <vector>

namespace wavepath {

// Whether some triangle lies within ray_offset (kernels) before or behind glass: a glass on a
// table, a liquid in a glass, a window that closes off fog, of one mesh or of several. Says yes
// rather than no. Faces that cross at more than half a degree do not count: they are that close on
// a line alone; nor do those side by side.
bool has_contacts(const Scene& scene, const NormalisedScene& geometry, const Bvh& bvh);

// The same of triangles that emit.
struct LampContacts {
    bool surfaces = false;  // something opaque touches one
    bool lamps = false;     // something that emits to the same side does
};

// Makes AT_LAMP what touches one in `triangle_lights` (LightTables), where that is NO_LIGHT.
LampContacts mark_lamp_contacts(
    const Scene& scene,
    const NormalisedScene& geometry,
    const Bvh& bvh,
    std::vector<uint32_t>& triangle_lights);

}  // namespace wavepath
