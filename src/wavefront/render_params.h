// The parameters of a render as kernels see them.
#pragma once

#include "prepare/prepared_scene.h"
#include "shared/params.h"
#include "wavefront/renderer.h"

namespace wavepath {

// All but the window's. Where the camera is in a medium, which begins at the eye, nothing before it
// counts as free: placed.free_distance becomes 0.
RenderParams params_of(const Scene& scene, PreparedScene& prepared, const RenderSettings& settings);

}  // namespace wavepath
