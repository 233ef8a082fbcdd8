// The media of a scene as kernels see them, and which of them surround the camera.
#pragma once

#include "prepare/media_bodies.h"
#include "prepare/normalise.h"
#include "scene/scene.h"
#include "shared/params.h"
#include "shared/scene.h"

#include <string>
#include <vector>

namespace wavepath {

struct MediaTables {
    std::vector<DeviceMedium> media;
    std::vector<uint32_t> rows;         // one a material: its row + 1, 0: encloses nothing
    bool scatter = false;               // some medium does
    bool emit = false;                  // some medium does
    bool refract = false;               // some boundary does
    bool refract_roughly = false;       // some boundary does, by microfacets
    std::vector<MediaBody> bodies;      // that enclose them
    std::vector<std::string> warnings;  // about bodies that enclose a medium badly
};

// Only materials that some triangle wears count. Throws Error for more media than MEDIUM_STACK can
// name.
MediaTables build_media_tables(const Scene& scene, const NormalisedScene& geometry);

// The largest sigma_t [1/normalised length] of the media that scatter and surround a point; 0:
// none.
double extinction_around(const Scene& scene, const MediaTables& tables, const Vec3d& point);

// MEDIUM_STACK of rays that start at the camera, whose fields `params` holds: the bodies around it,
// the smallest innermost. Throws Error where the plane that an orthographic camera's rays start in
// cuts through a boundary.
uint32_t media_at_camera(const Scene& scene, const MediaTables& tables, const RenderParams& params);

}  // namespace wavepath
