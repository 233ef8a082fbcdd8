// Whether a camera's rays start on a face of a body: then neither in its medium nor outside.
#pragma once

#include "prepare/media_bodies.h"
#include "shared/params.h"

namespace wavepath {

// Whether the film rectangle of an orthographic camera, which `params` holds, meets the triangle.
// One that lies in the film's plane counts with its box.
bool cuts_film(const MediaBody::Triangle& triangle, const RenderParams& params);

// Whether an eye is so close to the triangle that floats do not say on which side of it.
bool lies_on(const MediaBody::Triangle& triangle, const Vec3d& eye);

}  // namespace wavepath
