// What rendering needs of a scene, all in one.
#pragma once

#include "prepare/contacts.h"
#include "prepare/light_guide.h"
#include "prepare/placement.h"
#include "prepare/small_mesh.h"
#include "prepare/texture_tables.h"

namespace wavepath {

// What decides the tables besides the scene.
struct Preparation {
    uint32_t width = 1, height = 1;  // of the image
    LightChoice light_choice = LightChoice::power;
    bool lights_alone = false;  // no other way finds the environment (build_light_tables)
    bool aims = false;          // directions may be aimed: a guide is looked for
    uint64_t page_bytes = 0;    // most of textures in one buffer
    bool texture_rows = false;  // of materials also where none has a texture
};

struct PreparedScene {
    PlacedScene placed;      // triangles and their tree; all warnings
    std::vector<bool> worn;  // whether some triangle wears a material
    LightTables lights;      // of which AT_LAMP is marked
    MediaTables media;
    TextureTables textures;
    std::optional<SmallMesh> mesh;    // in place of the tree, where there are no holes
    std::optional<LightGuide> guide;  // where directions are worth aiming
    LampContacts at_lamps;
    bool has_contacts = false;     // something touches a lamp or glass
    double normalise_seconds = 0;  // all but the tree and what is asked of it
    double bvh_seconds = 0;

    const NormalisedScene& geometry() const { return placed.geometry; }
    bool has_area_lights() const;
};

// Throws Error where the scene cannot be rendered: no triangle has an area, more media or texels
// than can be held.
PreparedScene prepare(const Scene& scene, const Camera& camera, const Preparation& preparation);

}  // namespace wavepath
