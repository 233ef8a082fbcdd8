#pragma once

#include "scene/scene.h"

#include <string>

namespace wavepath {

// A camera at `eye` that looks at `target`, +Y up (+Z where it looks along Y). Throws Error if eye
// and target coincide.
Camera look_at(const Vec3d& eye, const Vec3d& target, double y_fov);

// The scene's camera of this name, on a node of this name, or of this index ("": its first; where
// it has none, one that sees the whole scene from the front, a little from above). Throws Error,
// listing what there is, for a name the scene does not have.
Camera choose_camera(const Scene& scene, const std::string& selector);

}  // namespace wavepath
