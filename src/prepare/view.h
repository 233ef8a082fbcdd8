// What a camera sees of a scene, in double.
#pragma once

#include "prepare/bvh_builder.h"
#include "prepare/normalise.h"

#include <cstdint>

namespace wavepath {

// From an eye that is farther off than this floats do not tell pixels apart [normalised].
constexpr double far_eye = 16;

// A camera in normalised space: at `eye`, seeing what lies up to half_width and half_height beside
// its axis, perspective at distance 1.
struct View {
    Vec3d eye;
    Vec3d x, y, forward;  // unit
    double half_width, half_height;
    bool orthographic;
};

// Of an image of `width` x `height` square pixels.
View view_of(
    const Camera& camera, const NormalisedScene& geometry, uint32_t width, uint32_t height);

// How far along its axis, from the eye, the view is free of triangles, less a little; infinite
// where it is empty.
double free_distance(const View& view, const NormalisedScene& geometry, const Bvh& bvh);

}  // namespace wavepath
