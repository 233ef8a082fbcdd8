#include "prepare/view.h"

#include "prepare/bvh_walk.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace wavepath {
namespace {

// The axes of these points are the camera's: to the right, up, and away from it.
using Polygon = std::vector<Vec3d>;

// What is inside all five sides is seen: to the right, left, top, bottom, and before the eye.
constexpr std::size_t sides = 5;

// Above 0 inside.
double inside(const View& view, std::size_t side, const Vec3d& p) {
    constexpr double wider = 1.001;
    const double scale = wider * (view.orthographic ? 1 : p[2]);
    switch (side) {
        case 0:
            return scale * view.half_width - p[0];
        case 1:
            return scale * view.half_width + p[0];
        case 2:
            return scale * view.half_height - p[1];
        case 3:
            return scale * view.half_height + p[1];
        default:
            return p[2];
    }
}

Vec3d seen_from(const View& view, const Vec3d& p) {
    const Vec3d from_eye = minus(p, view.eye);
    return {dot(from_eye, view.x), dot(from_eye, view.y), dot(from_eye, view.forward)};
}

// The part inside one side [Sutherland & Hodgman 1974].
Polygon clipped(const View& view, std::size_t side, const Polygon& polygon) {
    Polygon part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& a = polygon[i];
        const Vec3d& b = polygon[(i + 1) % polygon.size()];
        const double at_a = inside(view, side, a);
        const double at_b = inside(view, side, b);
        if (at_a >= 0) part.push_back(a);
        if ((at_a >= 0) == (at_b >= 0)) continue;
        const double t = at_a / (at_a - at_b);
        part.push_back(
            {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
    }
    return part;
}

double nearest_of(const Polygon& polygon) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& p : polygon) nearest = std::min(nearest, p[2]);
    return nearest;
}

// Of the box of a node's child; infinite where it is not seen.
double nearest_of_box(const View& view, const BvhNode& node, std::size_t child) {
    Polygon corners;
    for (std::size_t k = 0; k < 8; ++k)
        corners.push_back(seen_from(
            view, {node.bounds[0][k & 1U][child], node.bounds[1][k >> 1U & 1U][child],
                   node.bounds[2][k >> 2U][child]}));
    for (std::size_t side = 0; side < sides; ++side)
        if (std::ranges::all_of(corners, [&](const Vec3d& p) { return inside(view, side, p) < 0; }))
            return std::numeric_limits<double>::infinity();
    return nearest_of(corners);
}

double nearest_of_triangle(
    const View& view, const NormalisedScene& geometry, std::size_t triangle) {
    Polygon polygon;
    for (const Vec3d& corner : geometry.corners_of(triangle))
        polygon.push_back(seen_from(view, corner));
    for (std::size_t side = 0; side < sides; ++side) polygon = clipped(view, side, polygon);
    return nearest_of(polygon);
}

}  // namespace

View view_of(
    const Camera& camera, const NormalisedScene& geometry, uint32_t width, uint32_t height) {
    View view{};
    view.eye = geometry.to_normalised(axis(camera.to_world, 3));
    view.x = normalized(axis(camera.to_world, 0));
    view.y = normalized(axis(camera.to_world, 1));
    view.forward = minus({0, 0, 0}, normalized(axis(camera.to_world, 2)));
    view.orthographic = camera.orthographic;
    view.half_height =
        camera.orthographic ? camera.y_mag / geometry.extent.metres : std::tan(camera.y_fov / 2);
    view.half_width = view.half_height * width / height;
    return view;
}

double free_distance(const View& view, const NormalisedScene& geometry, const Bvh& bvh) {
    constexpr double rounding = 1e-4;  // of far corners
    double nearest = std::numeric_limits<double>::infinity();
    const auto may_be_nearer = [&](const BvhNode& node, std::size_t child) {
        return nearest_of_box(view, node, child) < nearest;
    };
    walk(bvh, may_be_nearer, [&](std::size_t triangle) {
        nearest = std::min(nearest, nearest_of_triangle(view, geometry, triangle));
        return false;
    });
    return (1 - rounding) * nearest;
}

}  // namespace wavepath
