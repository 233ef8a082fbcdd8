#include "scene/corner_normals.h"

#include "scene/transform.h"

#include <cmath>

namespace wavepath {

std::array<Vec3d, 3> corner_normals(const Primitive& primitive, std::size_t triangle) {
    const uint32_t* const vertices = &primitive.indices[3 * triangle];
    const Vec3d origin = vec3_at(primitive.positions, vertices[0]);
    const Vec3d face = normalized(cross(
        minus(vec3_at(primitive.positions, vertices[1]), origin),
        minus(vec3_at(primitive.positions, vertices[2]), origin)));
    std::array<Vec3d, 3> normals;
    Vec3d sum{0, 0, 0};  // of the normals times their cosines to the face: whatever their signs
    std::size_t behind = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        normals[c] = vec3_at(primitive.normals, vertices[c]);
        const double cosine = dot(normals[c], face);
        behind += cosine < 0 ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) sum[k] += cosine * normals[c][k];
    }
    // thin leaves have normals some way beyond the horizon of their faces
    constexpr double against = -0.4;  // cosine
    const double limit = against * std::sqrt(dot(sum, sum));
    for (Vec3d& normal : normals)
        if (dot(normal, face) < 0 && (behind == 3 || dot(normal, sum) < limit))
            for (double& component : normal) component = -component;
    return normals;
}

}  // namespace wavepath
