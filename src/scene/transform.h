// Affine transforms in double: a scene may lie 10^3 times its size away from the origin.
#pragma once

#include "scene/scene.h"

namespace wavepath {

Matrix4 multiply(const Matrix4& a, const Matrix4& b);

Matrix4 from_columns(const Vec3d& x, const Vec3d& y, const Vec3d& z, const Vec3d& position);

// Scales, then rotates, then translates. `rotation`: unit quaternion x, y, z, w.
Matrix4 compose(
    const Vec3d& translation, const std::array<double, 4>& rotation, const Vec3d& scale);

bool is_finite(const Matrix4& matrix);

// Maps every triangle to one of zero area: to a line or to a point.
bool flattens_triangles(const Matrix4& matrix);

inline Vec3d axis(const Matrix4& matrix, std::size_t column) {
    return {matrix[4 * column], matrix[4 * column + 1], matrix[4 * column + 2]};
}

// Row `row` of values that come in threes.
inline Vec3d vec3_at(const std::vector<float>& values, std::size_t row) {
    return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}

Vec3d transform_point(const Matrix4& matrix, const Vec3d& point);

// By the cofactors: the inverse transpose up to a positive factor, which also serves flattening
// matrices. Unit, or zero where it has no direction.
Vec3d transform_normal(const Matrix4& matrix, const Vec3d& normal);

Vec3d plus(const Vec3d& a, const Vec3d& b);

Vec3d minus(const Vec3d& a, const Vec3d& b);

Vec3d times(const Vec3d& a, double s);

double dot(const Vec3d& a, const Vec3d& b);

Vec3d cross(const Vec3d& a, const Vec3d& b);

// The zero vector where `v` has no direction.
Vec3d normalized(const Vec3d& v);

}  // namespace wavepath
