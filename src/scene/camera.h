#pragma once

#include "scene/placement.h"
#include "scene/scene.h"
#include "shared/params.h"

#include <cstdint>
#include <optional>
#include <string>

namespace wavepath {

// A camera at `eye` that looks at `target`, +Y up (+Z where it looks along Y). Throws Error if eye
// and target coincide.
Camera look_at(const Vec3d& eye, const Vec3d& target, double y_fov);

// The scene's camera of this name, on a node of this name, or of this index ("": its first; where
// it has none, one that sees the whole scene from the front, a little from above). Throws Error,
// listing what there is, for a name the scene does not have.
Camera choose_camera(const Scene& scene, const std::string& selector);

// Fills the camera fields of `params` for an image of `width` x `height` square pixels; the
// vertical extent is the camera's. Where the eye is far off (HAS_FAR_CAMERA) rays start at the
// scene, at a place known in double: rounding of the eye or of directions would carry them past
// pixels.
void set_camera(
    RenderParams& params,
    const Camera& camera,
    const PlacedScene& placed,
    uint32_t width,
    uint32_t height);

// Whether set_camera has found the camera far off.
bool is_far_camera(const RenderParams& params);

// Whether rounding of the rays that set_camera has laid stays well within a pixel of what lies
// about the origin.
bool tells_pixels_apart(const RenderParams& params);

}  // namespace wavepath
