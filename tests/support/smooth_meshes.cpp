#include "support/smooth_meshes.h"

#include "scene/transform.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace wavepath {

namespace {

Vec3d corner_of(const Primitive& primitive, uint32_t index) {
    const float* p = &primitive.positions[std::size_t{3} * index];
    return {p[0], p[1], p[2]};
}

}  // namespace

void shade_smooth(Primitive& primitive) {
    std::map<Vec3d, Vec3d> sums;
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        std::array<Vec3d, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = corner_of(primitive, primitive.indices[i + k]);
        const Vec3d n = cross(
            {p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]},
            {p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]});
        for (const Vec3d& corner : p)
            for (std::size_t k = 0; k < 3; ++k) sums[corner][k] += n[k];
    }
    primitive.normals.clear();
    for (uint32_t i = 0; i < primitive.positions.size() / 3; ++i)
        for (const double x : normalized(sums.at(corner_of(primitive, i))))
            primitive.normals.push_back(static_cast<float>(x));
}

Primitive& add_lathed(
    Scene& scene,
    const Material& material,
    const std::vector<std::pair<double, double>>& curve,
    unsigned steps) {
    const auto rows = static_cast<uint32_t>(curve.size());
    std::vector<float> positions;
    for (unsigned step = 0; step < steps; ++step) {
        const double turn = 2 * std::numbers::pi * step / steps;
        for (const auto& [radius, height] : curve)
            for (const double x : {radius * std::cos(turn), height, radius * std::sin(turn)})
                positions.push_back(static_cast<float>(x));
    }
    std::vector<uint32_t> indices;
    for (uint32_t step = 0; step < steps; ++step)
        for (uint32_t row = 0; row < rows; ++row) {
            const uint32_t next = (row + 1) % rows;
            const uint32_t here = step * rows;
            const uint32_t there = (step + 1) % steps * rows;
            if (curve[next].first > 0)
                indices.insert(indices.end(), {here + row, here + next, there + next});
            if (curve[row].first > 0)
                indices.insert(indices.end(), {here + row, there + next, there + row});
        }
    return add_triangles(scene, material, std::move(positions), std::move(indices));
}

}  // namespace wavepath
