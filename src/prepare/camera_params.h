// The camera as kernels see it.
#pragma once

#include "prepare/placement.h"
#include "shared/params.h"

#include <cstdint>

namespace wavepath {

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
