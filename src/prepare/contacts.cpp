#include "prepare/contacts.h"

#include "prepare/bvh_walk.h"
#include "scene/transform.h"
#include "shared/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wavepath {
namespace {

constexpr double touching_near = 0x1p-19;  // twice RAY_OFFSET, for rounding
constexpr double most_sine = 0.01;         // of faces that lie on one another but for rounding
constexpr double least_overlap = 0.25;  // of `touching`: faces of one surface meet at their sides

struct Triangle {
    std::array<Vec3d, 3> corners;
    Vec3d normal;  // unit
    double touching;
    Vec3d low, high;
};

Triangle triangle_at(const NormalisedScene& geometry, std::size_t index) {
    Triangle t;
    t.corners = geometry.corners_of(index);
    t.normal =
        normalized(cross(minus(t.corners[1], t.corners[0]), minus(t.corners[2], t.corners[0])));
    t.touching = touching_near * std::max(
                                     {coarseness_at(t.corners[0]), coarseness_at(t.corners[1]),
                                      coarseness_at(t.corners[2])});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] =
            std::minmax({t.corners[0][axis], t.corners[1][axis], t.corners[2][axis]});
        t.low[axis] = low - t.touching;
        t.high[axis] = high + t.touching;
    }
    return t;
}

// Whether all of `b`, seen along the normal, lies beyond one side of `a`.
bool lies_beyond_a_side(const Triangle& a, const Triangle& b) {
    for (std::size_t side = 0; side < 3; ++side) {
        const Vec3d& from = a.corners[side];
        const Vec3d inwards = normalized(cross(a.normal, minus(a.corners[(side + 1) % 3], from)));
        if (std::ranges::all_of(b.corners, [&](const Vec3d& corner) {
                return dot(inwards, minus(corner, from)) <= least_overlap * a.touching;
            }))
            return true;
    }
    return false;
}

bool touches(const Triangle& a, const Triangle& b) {
    const Vec3d sine = cross(a.normal, b.normal);
    if (dot(sine, sine) > most_sine * most_sine) return false;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return false;
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (const Vec3d& corner : b.corners) {
        const double height = dot(a.normal, minus(corner, a.corners[0]));
        nearest = std::min(nearest, height);
        farthest = std::max(farthest, height);
    }
    if (nearest > a.touching || farthest < -a.touching) return false;
    return !lies_beyond_a_side(a, b) && !lies_beyond_a_side(b, a);
}

// Calls `visit` with every triangle whose leaf's box meets that of `t`, until it says true.
template <typename Visit>
bool any_near(const Bvh& bvh, const Triangle& t, const Visit& visit) {
    const auto meets = [&](const BvhNode& node, std::size_t child) {
        bool both = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
            both = both && double{node.bounds[axis][0][child]} <= t.high[axis] &&
                   double{node.bounds[axis][1][child]} >= t.low[axis];
        return both;
    };
    return walk(bvh, meets, visit);
}

}  // namespace

bool has_contacts(const Scene& scene, const NormalisedScene& geometry, const Bvh& bvh) {
    const auto is_wall = [](const Material& material) {
        return material.boundary == Boundary::opaque && material.transmission > 0;
    };
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t) {
        const Material& glass = scene.materials[geometry.materials[t]];
        if (glass.boundary != Boundary::dielectric && !is_wall(glass)) continue;
        const Triangle face = triangle_at(geometry, t);
        const bool touched = any_near(bvh, face, [&](std::size_t other) {
            if (other == t) return false;
            const Material& material = scene.materials[geometry.materials[other]];
            return !is_wall(material) && touches(face, triangle_at(geometry, other));
        });
        if (touched) return true;
    }
    return false;
}

LampContacts mark_lamp_contacts(
    const Scene& scene,
    const NormalisedScene& geometry,
    const Bvh& bvh,
    std::vector<uint32_t>& triangle_lights) {
    LampContacts found;
    const auto material_of = [&](std::size_t t) -> const Material& {
        return scene.materials[geometry.materials[t]];
    };
    for (std::size_t t = 0; t < geometry.triangle_count(); ++t) {
        if (triangle_lights[t] >= AT_LAMP) continue;
        const Triangle lamp = triangle_at(geometry, t);
        any_near(bvh, lamp, [&](std::size_t other) {
            uint32_t& light = triangle_lights[other];
            if (other == t || light == AT_LAMP || material_of(other).boundary != Boundary::opaque)
                return false;
            const Triangle face = triangle_at(geometry, other);
            if (!touches(lamp, face)) return false;
            found.surfaces = true;
            if (light == NO_LIGHT)
                light = AT_LAMP;
            else
                found.lamps = found.lamps || material_of(t).double_sided ||
                              material_of(other).double_sided || dot(lamp.normal, face.normal) > 0;
            return false;
        });
    }
    return found;
}

}  // namespace wavepath
