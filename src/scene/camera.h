#pragma once

#include "scene/normalise.h"
#include "scene/scene.h"
#include "shared/params.h"

#include <cstdint>
#include <optional>
#include <string>

namespace wavepath {

// A camera at `eye` that looks at `target`, +Y up (+Z where it looks along Y). Throws Error if eye
// and target coincide.
Camera look_at(const Vec3d& eye, const Vec3d& target, double y_fov);

// The scene's camera of this name or index ("": its first; where it has none, one that sees the
// whole scene from the front, a little from above). Throws Error, listing what there is, for a name
// the scene does not have.
Camera choose_camera(const Scene& scene, const std::string& selector);

// Fills the camera fields of `params` for an image of `width` x `height` square pixels; the
// vertical extent is the camera's.
void set_camera(
    RenderParams& params,
    const Camera& camera,
    const NormalisedScene& geometry,
    uint32_t width,
    uint32_t height);

}  // namespace wavepath
