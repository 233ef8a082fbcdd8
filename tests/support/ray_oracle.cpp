#include "support/ray_oracle.h"

#include "support/embree_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace wavepath {
namespace {

using Point = std::array<double, 3>;

Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point widened(const std::array<float, 3>& p) {
    return {p[0], p[1], p[2]};
}

Point corner(const TestMesh& mesh, std::size_t triangle, std::size_t corner) {
    const float* p = &mesh.positions[9 * triangle + 3 * corner];
    return {p[0], p[1], p[2]};
}

// Of the line o + t d from the segment a b.
double line_segment_distance(const Point& o, const Point& d, const Point& a, const Point& b) {
    const Point e = minus(b, a);
    const Point r = minus(a, o);
    const double dd = dot(d, d);
    // Both without their part along d; then the nearest point of the segment to the origin.
    Point e_across{};
    Point r_across{};
    for (std::size_t k = 0; k < 3; ++k) {
        e_across[k] = e[k] - d[k] * dot(e, d) / dd;
        r_across[k] = r[k] - d[k] * dot(r, d) / dd;
    }
    const double ee = dot(e_across, e_across);
    const double s = ee > 0 ? std::clamp(-dot(r_across, e_across) / ee, 0.0, 1.0) : 0.0;
    Point nearest{};
    for (std::size_t k = 0; k < 3; ++k) nearest[k] = r_across[k] + s * e_across[k];
    return std::sqrt(dot(nearest, nearest));
}

std::array<float, 3> unit_vector(std::mt19937& random) {
    std::normal_distribution<float> normal;
    std::array<float, 3> v{};
    float length = 0;
    do {
        for (float& x : v) x = normal(random);
        length = std::hypot(v[0], v[1], v[2]);
    } while (length < 1e-3F);
    for (float& x : v) x /= length;
    return v;
}

}  // namespace

RayOracle::RayOracle(const TestMesh& mesh)
    : mesh_(mesh),
      scene_(embree_scene(mesh, "threads=1", RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_MEDIUM)) {}

TestHit RayOracle::closest(const TestRay& ray) const {
    return embree_trace(scene_.get(), ray, false);
}

Point RayOracle::point_of(const TestHit& hit) const {
    const auto triangle = static_cast<std::size_t>(hit.primitive);
    const Point a = corner(mesh_, triangle, 0);
    const Point b = corner(mesh_, triangle, 1);
    const Point c = corner(mesh_, triangle, 2);
    const double u = hit.u;
    const double v = hit.v;
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = (1 - u - v) * a[k] + u * b[k] + v * c[k];
    return p;
}

double RayOracle::edge_distance(const TestRay& ray, int primitive) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto triangle = static_cast<std::size_t>(primitive);
        least = std::min(
            least, line_segment_distance(
                       widened(ray.origin), widened(ray.direction), corner(mesh_, triangle, k),
                       corner(mesh_, triangle, (k + 1) % 3)));
    }
    return least;
}

bool RayOracle::passes_through(const TestRay& ray, int primitive) const {
    std::array<Point, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] =
            minus(corner(mesh_, static_cast<std::size_t>(primitive), k), widened(ray.origin));
    const Point d = widened(ray.direction);
    std::array<double, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Point& a = corners[k];
        const Point& b = corners[(k + 1) % 3];
        side[k] = d[0] * (a[1] * b[2] - a[2] * b[1]) + d[1] * (a[2] * b[0] - a[0] * b[2]) +
                  d[2] * (a[0] * b[1] - a[1] * b[0]);
    }
    const auto [least, most] = std::minmax_element(side.begin(), side.end());
    return *least >= 0 || *most <= 0;
}

bool RayOracle::is_on_ray(const TestRay& ray, const TestHit& hit) const {
    const auto triangle = static_cast<std::size_t>(hit.primitive);
    const Point u = minus(corner(mesh_, triangle, 1), corner(mesh_, triangle, 0));
    const Point v = minus(corner(mesh_, triangle, 2), corner(mesh_, triangle, 0));
    const Point normal{
        u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const Point d = widened(ray.direction);
    const double cosine = std::abs(dot(normal, d)) / std::sqrt(dot(normal, normal) * dot(d, d));
    Point apart = minus(point_of(hit), widened(ray.origin));
    for (std::size_t k = 0; k < 3; ++k) apart[k] -= double{hit.t} * d[k];
    return hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1 + 1e-6F &&
           std::sqrt(dot(apart, apart)) <= 1e-5 * std::max(1.0, 0.01 / cosine);  // inf: no plane
}

bool RayOracle::agree(const TestRay& ray, const TestHit& ours, const TestHit& theirs) const {
    if (ours.primitive >= 0 && !is_on_ray(ray, ours)) return false;
    if (ours.primitive == theirs.primitive) return true;
    if (ours.primitive >= 0 && theirs.primitive >= 0) {
        const Point apart = minus(point_of(ours), point_of(theirs));
        if (std::sqrt(dot(apart, apart)) <= 1e-5) return true;
    }
    const bool ours_first = theirs.primitive < 0 || (ours.primitive >= 0 && ours.t < theirs.t);
    const int stopped_at = ours_first ? ours.primitive : theirs.primitive;
    return edge_distance(ray, stopped_at) <= 1e-6 || passes_through(ray, stopped_at) == ours_first;
}

std::vector<TestRay> make_rays(
    const TestMesh& mesh, Aim aim, bool from_inside, std::size_t count, std::mt19937& random) {
    std::uniform_int_distribution<std::size_t> any_triangle(0, mesh.size() - 1);
    std::uniform_int_distribution<std::size_t> any_corner(0, 2);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<TestRay> rays(count);
    for (TestRay& ray : rays) {
        for (float& x : ray.origin) x = (from_inside ? 0.1F : 1.5F) * uniform(random);
        ray.t_max = std::numeric_limits<float>::infinity();
        const std::size_t triangle = any_triangle(random);
        const std::size_t k = any_corner(random);
        const Point a = corner(mesh, triangle, k);
        const Point b = corner(mesh, triangle, (k + 1) % 3);
        if (aim == Aim::random) ray.direction = unit_vector(random);
        if (aim == Aim::axis_parallel) {
            // Half of them start in the plane of a corner, so that they run along boxes' faces.
            const std::size_t axis = any_corner(random);
            ray.direction = {0.0F, -0.0F, 0.0F};
            ray.direction[axis] = uniform(random) < 0 ? -1.0F : 1.0F;
            if (!from_inside && uniform(random) < 0)
                ray.origin[(axis + 1) % 3] = static_cast<float>(a[(axis + 1) % 3]);
        }
        if (aim == Aim::edge || aim == Aim::vertex) {
            const double s =
                aim == Aim::vertex ? 0 : 0.5 + 0.5 * static_cast<double>(uniform(random));
            for (std::size_t axis = 0; axis < 3; ++axis)
                ray.direction[axis] = static_cast<float>(
                    a[axis] + s * (b[axis] - a[axis]) - static_cast<double>(ray.origin[axis]));
        }
    }
    return rays;
}

std::vector<TestRay> degenerate_rays() {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    std::vector<TestRay> rays;
    for (const float x : {nan, inf, 0.0F, 1e-30F, 1e30F}) {
        rays.push_back({{x, 0, 0}, {1, 0, 0}, inf});
        rays.push_back({{0, 0, 0}, {x, 0, 0}, inf});
        rays.push_back({{0, 0, 0}, {x, x, x}, inf});
        rays.push_back({{0, 0, 0}, {1, 0, 0}, x});
    }
    return rays;
}

std::vector<float> floats_of(const std::vector<TestRay>& rays) {
    std::vector<float> floats(8 * rays.size());
    std::memcpy(floats.data(), rays.data(), rays.size() * sizeof(TestRay));
    return floats;
}

}  // namespace wavepath
