#pragma once

#include "scene/extent.h"

#include <array>
#include <cstdint>
#include <vector>

namespace wavepath {

// The scene's triangles in one list, moved and scaled so that a cube, which is their bounding box
// or what the camera looks at in a much larger one (prepare/placement.h), is centred at the origin
// and its side is 1: offsets and epsilons are then free of scale. world = extent.centre +
// extent.metres
// * normalised.
struct NormalisedScene {
    Extent extent;
    std::vector<float> positions;           // 9 a triangle
    std::vector<float> normals;             // 9 a triangle, or empty: every triangle is flat
    std::vector<float> colors;              // 9 a triangle, or empty: all white
    std::array<std::vector<float>, 2> uvs;  // 6 a triangle, or empty: no texture uses the set
    std::vector<float> tangents;            // 9 a triangle, or empty: there is no normal map
    std::vector<float> bitangents;  // one a triangle with tangents: 1 or -1, for bitangent = that *
                                    // cross(normal, tangent)
    std::vector<float> alphas;      // 3 a triangle, or empty: all 1
    std::vector<uint32_t> materials;  // one a triangle
    std::vector<uint32_t> ends;       // of each instance's triangles
    std::vector<PunctualLight>
        lights;  // positions and ranges normalised; point and spot intensity / metres^2
    std::size_t dropped = 0;  // triangles of zero area, left out
    std::size_t lost = 0;     // of them: too small for floats here, but no lines or points
    double side = 1;          // the longest of the bounding box of all instances [normalised]
    double reach = 0.8660254037844386;  // no corner is farther from the origin

    // Whether triangles lie outside the unit cube.
    bool is_far() const { return reach > 0.8661; }

    std::size_t triangle_count() const { return materials.size(); }
    Vec3d to_normalised(const Vec3d& world) const;
    std::array<Vec3d, 3> corners_of(std::size_t triangle) const;
};

// By how much rounding at p exceeds that in the unit cube, and so ray_offset of the kernels
// RAY_OFFSET: 1 or more.
double coarseness_at(const Vec3d& p);

// Applies node transforms in double. A mirroring transform (negative determinant) reverses the
// winding, so that fronts stay fronts. Throws Error where nothing has an area or the extent is not
// finite.
NormalisedScene normalise(const Scene& scene);

// The same about another cube than the bounding box: triangles that leave it are cut into pieces
// that are small beside their distance from it (prepare/subdivide.h).
NormalisedScene normalise(const Scene& scene, const Extent& extent);

}  // namespace wavepath
