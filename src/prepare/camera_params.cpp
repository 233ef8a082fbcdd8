#include "prepare/camera_params.h"

#include "prepare/view.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>

namespace wavepath {

namespace {

void store(float& x, float& y, float& z, const Vec3d& v) {
    x = static_cast<float>(v[0]);
    y = static_cast<float>(v[1]);
    z = static_cast<float>(v[2]);
}

}  // namespace

void set_camera(
    RenderParams& params,
    const Camera& camera,
    const PlacedScene& placed,
    uint32_t width,
    uint32_t height) {
    const NormalisedScene& geometry = placed.geometry;
    const View view = view_of(camera, geometry, width, height);
    const double pixel = 2 * view.half_height / height;
    const double radius = geometry.is_far() ? 1.0001 * geometry.reach : 0.8661;  // around all
    const double to_centre = camera.orthographic
                                 ? -dot(view.eye, view.forward)
                                 : std::hypot(view.eye[0], view.eye[1], view.eye[2]);
    double ray_start = std::max(0.0, to_centre - radius);
    if (std::isfinite(placed.free_distance)) ray_start = std::max(ray_start, placed.free_distance);
    const bool is_far = ray_start > far_eye;
    const Vec3d start = is_far ? plus(view.eye, times(view.forward, ray_start)) : view.eye;
    Vec3d corner = plus(times(view.x, -0.5 * pixel * width), times(view.y, view.half_height));
    if (camera.orthographic)
        corner = plus(corner, start);
    else if (!is_far)
        corner = plus(corner, view.forward);
    store(
        params.camera_x, params.camera_y, params.camera_z,
        camera.orthographic ? view.forward : start);
    store(params.forward_x, params.forward_y, params.forward_z, view.forward);
    store(params.corner_x, params.corner_y, params.corner_z, corner);
    store(params.right_x, params.right_y, params.right_z, times(view.x, pixel));
    store(params.down_x, params.down_y, params.down_z, times(view.y, -pixel));
    params.orthographic = camera.orthographic ? 1 : 0;
    params.ray_start = static_cast<float>(ray_start);
    params.metres = static_cast<float>(geometry.extent.metres);
    params.width = width;
    params.height = height;
}

bool is_far_camera(const RenderParams& params) {
    return params.ray_start > far_eye;
}

bool tells_pixels_apart(const RenderParams& params) {
    const bool orthographic = params.orthographic != 0;
    const double pixel = std::hypot(params.right_x, params.right_y, params.right_z);
    const double start = orthographic
                             ? std::hypot(params.corner_x, params.corner_y, params.corner_z)
                             : std::hypot(params.camera_x, params.camera_y, params.camera_z);
    const double distance = start + (is_far_camera(params) ? params.ray_start : 0);
    const double width = orthographic ? pixel : pixel * std::max(distance, 0.5);
    const double rounding = 0x1p-23 * std::max(start, 1.0);
    return rounding < 0.25 * width;
}

}  // namespace wavepath
