#include "gltf/gltf_nodes.h"
#include "scene/transform.h"

#include <numbers>

namespace wavepath {
namespace {

// Looks along the node's -Z exactly; X follows from Y and Z, so that a mirrored node does not
// mirror the picture.
Matrix4 camera_frame(const GltfFile& file, const PlacedNode& placed) {
    const Vec3d z = normalized(axis(placed.to_world, 2));
    const Vec3d x = normalized(cross(normalized(axis(placed.to_world, 1)), z));
    const Vec3d y = cross(z, x);
    if (x == Vec3d{0, 0, 0})
        file.fail(
            placed.label, "its scale leaves the camera no direction; give it a scale other than 0");
    return from_columns(x, y, z, axis(placed.to_world, 3));
}

}  // namespace

std::optional<Camera> read_camera(const GltfFile& file, const PlacedNode& placed) {
    const int index = placed.node.camera;
    if (index == -1) return std::nullopt;
    const tinygltf::Camera& source = file.at(file.model.cameras, index, "camera", placed.label);
    const std::string where = label("camera", index, source.name);

    Camera camera;
    camera.name = source.name.empty() ? placed.node.name : source.name;
    camera.node = placed.node.name;
    camera.orthographic = source.type == "orthographic";
    camera.to_world = camera_frame(file, placed);
    if (camera.orthographic) {
        camera.x_mag = source.orthographic.xmag;
        camera.y_mag = source.orthographic.ymag;
        if (!(camera.x_mag > 0 && camera.y_mag > 0))
            file.fail(
                where, "xmag {} and ymag {} must be positive; repair them", camera.x_mag,
                camera.y_mag);
        camera.aspect_ratio = camera.x_mag / camera.y_mag;
    } else {
        camera.y_fov = source.perspective.yfov;
        camera.aspect_ratio = source.perspective.aspectRatio;
        if (!(camera.y_fov > 0 && camera.y_fov < std::numbers::pi))
            file.fail(where, "yfov is {} rad, not between 0 and pi; repair it", camera.y_fov);
        if (!(camera.aspect_ratio >= 0))
            file.fail(
                where, "aspectRatio is {}, not positive; repair or remove it", camera.aspect_ratio);
    }
    return camera;
}

}  // namespace wavepath
