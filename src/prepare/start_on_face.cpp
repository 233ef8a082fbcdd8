#include "prepare/start_on_face.h"

#include "prepare/normalise.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wavepath {
namespace {

Vec3d point(const MediaBody::Point& p) {
    return {p[0], p[1], p[2]};
}

using Pixel = std::array<double, 2>;

// Whether a segment meets the rectangle from (0, 0) to `size` [Liang & Barsky 1984].
bool meets_film(const Pixel& a, const Pixel& b, const Pixel& size) {
    constexpr double margin = 1e-3;  // [pixel] far beyond rounding
    double first = 0;
    double last = 1;
    for (std::size_t j = 0; j < 2; ++j) {
        const double step = b[j] - a[j];
        const double low = -margin - a[j];
        const double high = size[j] + margin - a[j];
        if (step == 0 && (low > 0 || high < 0)) return false;
        if (step == 0) continue;
        first = std::max(first, std::min(low / step, high / step));
        last = std::min(last, std::max(low / step, high / step));
    }
    return first <= last;
}

}  // namespace

bool cuts_film(const MediaBody::Triangle& triangle, const RenderParams& params) {
    const Vec3d corner{params.corner_x, params.corner_y, params.corner_z};
    const Vec3d normal{params.camera_x, params.camera_y, params.camera_z};
    const Vec3d right{params.right_x, params.right_y, params.right_z};
    const Vec3d down{params.down_x, params.down_y, params.down_z};
    std::vector<Pixel> cut;  // where its sides meet the plane
    bool lies_in_plane = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d a = minus(point(triangle[k]), corner);
        const Vec3d b = minus(point(triangle[(k + 1) % 3]), corner);
        const double da = dot(a, normal);
        const double db = dot(b, normal);
        lies_in_plane = lies_in_plane && da == 0;
        if (da * db > 0) continue;
        const double at = da == db ? 0 : da / (da - db);
        const Vec3d p{
            a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1]), a[2] + at * (b[2] - a[2])};
        cut.push_back({dot(p, right) / dot(right, right), dot(p, down) / dot(down, down)});
    }
    if (cut.empty()) return false;
    const Pixel size{static_cast<double>(params.width), static_cast<double>(params.height)};
    if (lies_in_plane) {
        const auto [left, right_end] = std::minmax({cut[0][0], cut[1][0], cut[2][0]});
        const auto [top, bottom] = std::minmax({cut[0][1], cut[1][1], cut[2][1]});
        return left <= size[0] && right_end >= 0 && top <= size[1] && bottom >= 0;
    }
    for (std::size_t k = 0; k < cut.size(); ++k)
        if (meets_film(cut[k], cut[(k + 1) % cut.size()], size)) return true;
    return false;
}

bool lies_on(const MediaBody::Triangle& triangle, const Vec3d& eye) {
    const double nearest = 0x1p-21 * coarseness_at(eye);
    const std::array<Vec3d, 3> corners{point(triangle[0]), point(triangle[1]), point(triangle[2])};
    const Vec3d normal =
        normalized(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])));
    if (!(std::abs(dot(normal, minus(eye, corners[0]))) <= nearest)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d side = normalized(minus(corners[(k + 1) % 3], corners[k]));
        if (dot(cross(normal, side), minus(eye, corners[k])) < -nearest) return false;
    }
    return true;
}

}  // namespace wavepath
