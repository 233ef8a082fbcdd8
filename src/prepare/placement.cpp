#include "prepare/placement.h"

#include "error.h"
#include "prepare/view.h"
#include "scene/transform.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace wavepath {
namespace {

constexpr std::size_t rays_a_side = 32;

// Rays leave a surface 2^-20 units off, or 2^-19 of its distance from the origin. Up to this many
// units in what is seen that is a 2^-12th of it, an eighth of a pixel of a picture of 512.
constexpr double coarse = 256;
constexpr double fine = 4;             // down to as many there is nothing to gain
constexpr std::size_t least_rays = 4;  // that see something

// Units that floats reach: their squares' squares fit, and those of areas.
constexpr double farthest = 0x1p29;

struct Ray {
    Vec3d origin, direction;  // [normalised], unit
};

// What a ray of the camera meets first.
struct Seen {
    Vec3d position;  // [normalised]
    double height;   // of what the image shows at that distance [normalised]
    double size;     // that or the triangle's longest edge: what offsets are to be small beside
};

Vec3d along(const Ray& ray, double t) {
    return {
        ray.origin[0] + t * ray.direction[0], ray.origin[1] + t * ray.direction[1],
        ray.origin[2] + t * ray.direction[2]};
}

double length(const Vec3d& v) {
    return std::sqrt(dot(v, v));
}

// Distance to the triangle, or infinity [Moeller & Trumbore 1997].
double distance_to(const Ray& ray, const std::array<Vec3d, 3>& corners) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const Vec3d e = minus(corners[1], corners[0]);
    const Vec3d f = minus(corners[2], corners[0]);
    const Vec3d p = cross(ray.direction, f);
    const double det = dot(e, p);
    if (det == 0) return none;
    const Vec3d s = minus(ray.origin, corners[0]);
    const double u = dot(s, p) / det;
    const Vec3d q = cross(s, e);
    const double v = dot(ray.direction, q) / det;
    const double t = dot(f, q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : none;
}

// Where the ray enters the box of a node's child, or infinity.
double entry_of(const Ray& ray, const BvhNode& node, std::size_t child) {
    double near = 0;
    double far = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = node.bounds[axis][0][child] - ray.origin[axis];
        const double high = node.bounds[axis][1][child] - ray.origin[axis];
        if (ray.direction[axis] == 0) {
            if (low > 0 || high < 0) return std::numeric_limits<double>::infinity();
            continue;
        }
        const auto [first, last] =
            std::minmax({low / ray.direction[axis], high / ray.direction[axis]});
        near = std::max(near, first);
        far = std::min(far, last);
    }
    return near <= far ? near : std::numeric_limits<double>::infinity();
}

// The closest triangle and its distance; infinity where there is none.
std::pair<double, std::size_t> closest(const PlacedScene& placed, const Ray& ray) {
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
    waiting.emplace(0.0, 0U);
    std::pair<double, std::size_t> best{std::numeric_limits<double>::infinity(), 0};
    while (!waiting.empty() && waiting.top().first < best.first) {
        const uint32_t current = waiting.top().second;
        waiting.pop();
        if ((current & BVH_LEAF) != 0) {
            for (const uint32_t entry : placed.bvh.blocks[current & ~BVH_LEAF].primitives) {
                if (entry == BVH_EMPTY) continue;
                best = std::min(best, {distance_to(ray, placed.geometry.corners_of(entry)), entry});
            }
            continue;
        }
        const BvhNode& node = placed.bvh.nodes[current];
        for (std::size_t k = 0; k < 8; ++k) {
            if (node.children[k] == BVH_EMPTY) continue;
            const double near = entry_of(ray, node, k);
            if (near < best.first) waiting.emplace(near, node.children[k]);
        }
    }
    return best;
}

// What a grid of rays through the image sees.
std::vector<Seen> seen_by(const View& view, const PlacedScene& placed) {
    const auto along_side = [](std::size_t i) {
        return 2 * (static_cast<double>(i) + 0.5) / rays_a_side - 1;
    };
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < rays_a_side * rays_a_side; ++i) {
        const double right = view.half_width * along_side(i % rays_a_side);
        const double up = view.half_height * along_side(i / rays_a_side);
        Ray ray{view.eye, view.forward};
        for (std::size_t k = 0; k < 3; ++k)
            (view.orthographic ? ray.origin : ray.direction)[k] +=
                right * view.x[k] + up * view.y[k];
        ray.direction = normalized(ray.direction);
        const auto [t, triangle] = closest(placed, ray);
        if (!std::isfinite(t)) continue;
        const double height = 2 * view.half_height * (view.orthographic ? 1 : t);
        const std::array<Vec3d, 3> p = placed.geometry.corners_of(triangle);
        const double size = std::max(
            {height, length(minus(p[1], p[0])), length(minus(p[2], p[1])),
             length(minus(p[0], p[2]))});
        seen.push_back({along(ray, t), height, size});
    }
    return seen;
}

// In what is seen: the larger, the more an offset shows. `unit` and `origin` are those of a space.
double units_in(const Seen& seen, double unit, const Vec3d& origin) {
    return std::max(unit, 2 * length(minus(seen.position, origin))) / seen.size;
}

PlacedScene placed_in(const Scene& scene, const Extent& extent) {
    PlacedScene placed{normalise(scene, extent), {}, 0, {}};
    placed.bvh = build_bvh(placed.geometry.positions);
    return placed;
}

}  // namespace

std::optional<Extent> subject_of(
    const PlacedScene& placed, const Camera& camera, uint32_t width, uint32_t height) {
    const std::vector<Seen> seen = seen_by(view_of(camera, placed.geometry, width, height), placed);
    const auto is_coarse = [](const Seen& s) { return units_in(s, 1, {0, 0, 0}) > coarse; };
    if (std::ranges::count_if(seen, is_coarse) < std::ptrdiff_t{least_rays}) return std::nullopt;
    // Of the points seen the one that suits most of all others, if it is better than the origin.
    const std::size_t step = seen.size() / 256 + 1;
    const auto cost_of = [&](double unit, const Vec3d& origin) {
        double cost = 0;
        for (const Seen& s : seen) cost += std::log2(std::max(fine, units_in(s, unit, origin)));
        return cost;
    };
    const Seen* best = nullptr;
    double least = cost_of(1, {0, 0, 0}) - least_rays * std::log2(coarse / fine);
    for (std::size_t i = 0; i < seen.size(); i += step) {
        const double cost = cost_of(seen[i].height, seen[i].position);
        if (cost > least || (cost == least && best && seen[i].height <= best->height)) continue;
        best = &seen[i];
        least = cost;
    }
    if (best == nullptr) return std::nullopt;
    const Extent& now = placed.geometry.extent;
    Extent subject;
    for (std::size_t k = 0; k < 3; ++k)
        subject.centre[k] = now.centre[k] + now.metres * best->position[k];
    subject.metres = now.metres * best->height;
    return subject;
}

PlacedScene place(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height) {
    const Extent whole = extent_of(scene);
    PlacedScene placed = placed_in(scene, whole);
    // What is so small that nothing is left of it shows from close by.
    if (placed.geometry.lost > 0)
        placed = placed_in(scene, {axis(camera.to_world, 3), whole.metres * 0x1p-24});
    // What a space shows is as coarse as it is itself: the next one is laid by what it shows.
    constexpr int most_looks = 4;
    for (int look = 0; look < most_looks; ++look) {
        std::optional<Extent> subject = subject_of(placed, camera, width, height);
        if (!subject) break;
        const bool too_small = subject->metres < whole.metres / farthest;
        subject->metres = std::max(subject->metres, whole.metres / farthest);
        placed = placed_in(scene, *subject);
        if (!too_small) continue;
        placed.warnings.push_back(fmt::format(
            "{}: {:.3g} m across, it is too large for what the camera sees: what is finer than "
            "{:.1g} m there is lost; take away what lies far off",
            scene.name, whole.metres, subject->metres * 0x1p-19));
        break;
    }
    placed.geometry.side = whole.metres / placed.geometry.extent.metres;
    if (placed.geometry.materials.empty())
        throw Error(
            "{}: its triangles are too small beside its {:.3g} m for single precision; take away "
            "what lies far off",
            scene.name, whole.metres);
    if (placed.geometry.lost > 0)
        placed.warnings.push_back(fmt::format(
            "{}: {} triangles are too small beside its {:.3g} m for single precision and left out; "
            "take away what lies far off",
            scene.name, placed.geometry.lost, whole.metres));
    const View view = view_of(camera, placed.geometry, width, height);
    if (length(view.eye) > far_eye)
        placed.free_distance = free_distance(view, placed.geometry, placed.bvh);
    return placed;
}

}  // namespace wavepath
