#include "scene/camera.h"

#include "error.h"
#include "scene/extent.h"
#include "scene/transform.h"

#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavepath {

namespace {

Camera overview(const Extent& extent) {
    constexpr double y_fov = std::numbers::pi / 4;
    // the bounding sphere of the unit cube around the origin fits the field of view
    const double distance = extent.metres * 0.8660254037844386 / std::sin(y_fov / 2);
    const Vec3d towards_eye = normalized({0.25, 0.35, 1.0});
    return look_at(plus(extent.centre, times(towards_eye, distance)), extent.centre, y_fov);
}

}  // namespace

Camera look_at(const Vec3d& eye, const Vec3d& target, double y_fov) {
    const Vec3d z = normalized(minus(eye, target));
    if (z == Vec3d{0, 0, 0})
        throw Error("--look-at: eye and target are the same point; move one of them");
    const Vec3d up = std::hypot(z[0], z[2]) > 1e-6 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
    const Vec3d x = normalized(cross(up, z));
    const Vec3d y = cross(z, x);
    Camera camera;
    camera.name = "look-at";
    camera.y_fov = y_fov;
    camera.to_world = {x[0], x[1], x[2], 0, y[0],   y[1],   y[2],   0,
                       z[0], z[1], z[2], 0, eye[0], eye[1], eye[2], 1};
    return camera;
}

Camera choose_camera(const Scene& scene, const std::string& selector) {
    if (selector.empty() && scene.cameras.empty()) {
        Camera camera = overview(extent_of(scene));
        camera.name = "overview";
        return camera;
    }
    const auto numbered = [&](std::size_t index) {
        Camera camera = scene.cameras[index];
        if (camera.name.empty()) camera.name = std::to_string(index);  // what --camera calls it
        return camera;
    };
    if (selector.empty()) return numbered(0);
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == selector) return camera;
        names.push_back(camera.name);
        if (!camera.node.empty() && camera.node != camera.name)
            names.back() += fmt::format(" (on \"{}\")", camera.node);
    }
    for (const Camera& camera : scene.cameras)
        if (camera.node == selector) return camera;
    const bool is_number =
        selector.find_first_not_of("0123456789") == std::string::npos && selector.size() < 9;
    if (is_number && std::stoul(selector) < scene.cameras.size())
        return numbered(std::stoul(selector));
    throw Error(
        "--camera {}: {} has {} camera(s){}{}; name one of them by index or name, or use --look-at",
        selector, scene.name, scene.cameras.size(), names.empty() ? "" : ": ",
        fmt::join(names, ", "));
}

}  // namespace wavepath
