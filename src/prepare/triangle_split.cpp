#include "prepare/triangle_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wavepath {
namespace {

using Vec3 = std::array<float, 3>;

Vec3 corner_of(const std::vector<float>& positions, std::size_t triangle, std::size_t corner) {
    const float* p = &positions[9 * triangle + 3 * corner];
    return {p[0], p[1], p[2]};
}

struct Box {
    Vec3 low{inf, inf, inf};
    Vec3 high{-inf, -inf, -inf};

    void add(const Vec3& from, const Vec3& to) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], from[axis]);
            high[axis] = std::max(high[axis], to[axis]);
        }
    }
    void add(const Vec3& point) { add(point, point); }

    void clip(const RTCBuildPrimitive& primitive) {
        const Vec3 lower{primitive.lower_x, primitive.lower_y, primitive.lower_z};
        const Vec3 upper{primitive.upper_x, primitive.upper_y, primitive.upper_z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::max(low[axis], lower[axis]);
            high[axis] = std::min(high[axis], upper[axis]);
        }
    }

    RTCBounds bounds() const { return {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0}; }

    static constexpr float inf = std::numeric_limits<float>::infinity();
};

}  // namespace

RTCBounds triangle_bounds(const std::vector<float>& positions, std::size_t triangle) {
    Box box;
    for (std::size_t corner = 0; corner < 3; ++corner)
        box.add(corner_of(positions, triangle, corner));
    return box.bounds();
}

bool has_area(const std::vector<float>& positions, std::size_t triangle) {
    const float* p = &positions[9 * triangle];
    std::array<double, 3> e{};
    std::array<double, 3> f{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        e[axis] = static_cast<double>(p[3 + axis]) - static_cast<double>(p[axis]);
        f[axis] = static_cast<double>(p[6 + axis]) - static_cast<double>(p[axis]);
    }
    return e[1] * f[2] != e[2] * f[1] || e[2] * f[0] != e[0] * f[2] || e[0] * f[1] != e[1] * f[0];
}

void split_triangle(
    const RTCBuildPrimitive* primitive,
    unsigned dimension,
    float plane,
    RTCBounds* left,
    RTCBounds* right,
    void* positions) {
    const auto& floats = *static_cast<const std::vector<float>*>(positions);
    const float lower = (&primitive->lower_x)[dimension];
    const float upper = (&primitive->upper_x)[dimension];
    Box below;
    Box above;
    Vec3 a = corner_of(floats, primitive->primID, 2);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 b = corner_of(floats, primitive->primID, i);
        if (b[dimension] <= plane) below.add(b);
        if (b[dimension] >= plane) above.add(b);
        if (std::min(a[dimension], b[dimension]) < plane &&
            plane < std::max(a[dimension], b[dimension])) {
            // The edge crosses here, give or take 8 ulp of its ends: more than the rounding.
            const float s = (plane - a[dimension]) / (b[dimension] - a[dimension]);
            Vec3 from{};
            Vec3 to{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float cut = a[axis] + s * (b[axis] - a[axis]);
                const float margin = 4.8e-7F * (std::abs(a[axis]) + std::abs(b[axis]));
                from[axis] = cut - margin;
                to[axis] = cut + margin;
            }
            below.add(from, to);
            above.add(from, to);
        }
        a = b;
    }
    below.high[dimension] = std::min(below.high[dimension], plane);
    above.low[dimension] = std::max(above.low[dimension], plane);
    below.clip(*primitive);
    above.clip(*primitive);
    // Embree sorts parts by the rounded middle of their boxes, and asserts that both sides get
    // some: a part thinner than that rounding would count on the other side.
    const float least = 0x1p-20F * std::max({std::abs(plane), std::abs(lower), std::abs(upper)});
    below.low[dimension] = std::min(below.low[dimension], plane - least);
    above.high[dimension] = std::max(above.high[dimension], plane + least);
    *left = below.bounds();
    *right = above.bounds();
}

}  // namespace wavepath
