#include "scene/transform.h"

#include <algorithm>
#include <cmath>

namespace wavepath {

Matrix4 multiply(const Matrix4& a, const Matrix4& b) {
    Matrix4 product{};
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t k = 0; k < 4; ++k)
                product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return product;
}

Matrix4 from_columns(const Vec3d& x, const Vec3d& y, const Vec3d& z, const Vec3d& position) {
    Matrix4 matrix = identity_matrix;
    std::size_t column = 0;
    for (const Vec3d& v : {x, y, z, position})
        std::ranges::copy(v, matrix.begin() + static_cast<std::ptrdiff_t>(4 * column++));
    return matrix;
}

Matrix4 compose(
    const Vec3d& translation, const std::array<double, 4>& rotation, const Vec3d& scale) {
    const auto [x, y, z, w] = rotation;
    std::array<Vec3d, 3> axes{{
        {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
        {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
        {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
    }};
    for (std::size_t i = 0; i < 3; ++i)
        for (double& component : axes[i]) component *= scale[i];
    return from_columns(axes[0], axes[1], axes[2], translation);
}

bool is_finite(const Matrix4& matrix) {
    return std::ranges::all_of(matrix, [](double element) { return std::isfinite(element); });
}

bool flattens_triangles(const Matrix4& matrix) {
    // The cofactors map areas: all zero where the rank of the linear part is below 2.
    const Vec3d x = axis(matrix, 0), y = axis(matrix, 1), z = axis(matrix, 2);
    constexpr Vec3d zero{0, 0, 0};
    return cross(x, y) == zero && cross(y, z) == zero && cross(z, x) == zero;
}

Vec3d transform_point(const Matrix4& m, const Vec3d& p) {
    Vec3d r;
    for (std::size_t k = 0; k < 3; ++k)
        r[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
    return r;
}

Vec3d transform_normal(const Matrix4& m, const Vec3d& n) {
    const std::array<Vec3d, 3> columns{
        cross(axis(m, 1), axis(m, 2)), cross(axis(m, 2), axis(m, 0)),
        cross(axis(m, 0), axis(m, 1))};
    const double sign = dot(axis(m, 0), columns[0]) < 0 ? -1 : 1;  // the determinant's
    Vec3d r{0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) r[k] += sign * n[c] * columns[c][k];
    return normalized(r);
}

Vec3d plus(const Vec3d& a, const Vec3d& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Vec3d times(const Vec3d& a, double s) {
    return {a[0] * s, a[1] * s, a[2] * s};
}

Vec3d minus(const Vec3d& a, const Vec3d& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Vec3d& a, const Vec3d& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3d cross(const Vec3d& a, const Vec3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3d normalized(const Vec3d& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    if (!(length > 0)) return {0, 0, 0};
    return {v[0] / length, v[1] / length, v[2] / length};
}

}  // namespace wavepath
