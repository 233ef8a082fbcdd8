#include "gltf/tangents.h"

#include "scene/corner_normals.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace wavepath {
namespace {

void add_scaled(Vec3d& sum, const Vec3d& v, double s) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += s * v[k];
}

// `v` without its part along the unit vector `n`, unit; zero where nothing is left.
Vec3d in_plane(Vec3d v, const Vec3d& n) {
    add_scaled(v, n, -dot(v, n));
    return normalized(v);
}

// Any unit vector across `n`.
Vec3d across(const Vec3d& n) {
    return normalized(cross(std::abs(n[0]) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}, n));
}

// A vertex by what it is, not by its index, and which way round its triangle's coordinates run.
using Key = std::array<float, 9>;

struct Face {
    std::array<Vec3d, 3> corners, normals;
    std::array<Key, 3> keys;
    Vec3d along_u;      // not unit; zero where the coordinates have no area
    double handedness;  // 1, or -1 where the coordinates run the other way round
};

Face face_at(const Primitive& primitive, const std::vector<float>& uvs, std::size_t triangle) {
    Face face;
    std::array<std::array<double, 2>, 3> uv;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t vertex = primitive.indices[3 * triangle + c];
        face.corners[c] = vec3_at(primitive.positions, vertex);
        uv[c] = {uvs[2 * vertex], uvs[2 * vertex + 1]};
    }
    const Vec3d e1 = minus(face.corners[1], face.corners[0]);
    const Vec3d e2 = minus(face.corners[2], face.corners[0]);
    const double u1 = uv[1][0] - uv[0][0];
    const double v1 = uv[1][1] - uv[0][1];
    const double u2 = uv[2][0] - uv[0][0];
    const double v2 = uv[2][1] - uv[0][1];
    const double area = u1 * v2 - u2 * v1;
    // v runs down in images and up in the bitangent
    face.handedness = area < 0 ? 1 : -1;
    face.along_u = {0, 0, 0};
    if (area != 0) {
        add_scaled(face.along_u, e1, v2 / area);
        add_scaled(face.along_u, e2, -v1 / area);
    }
    if (primitive.normals.empty())
        face.normals.fill(normalized(cross(e1, e2)));
    else
        face.normals = corner_normals(primitive, triangle);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < 3; ++k) {
            face.keys[c][k] = static_cast<float>(face.corners[c][k]);
            face.keys[c][3 + k] = static_cast<float>(face.normals[c][k]);
        }
        face.keys[c][6] = static_cast<float>(uv[c][0]);
        face.keys[c][7] = static_cast<float>(uv[c][1]);
        face.keys[c][8] = static_cast<float>(face.handedness);
    }
    return face;
}

// Between the edges at corner `c`, seen along its normal.
double angle_at(const Face& face, std::size_t c) {
    const Vec3d& here = face.corners[c];
    const Vec3d a = in_plane(minus(face.corners[(c + 1) % 3], here), face.normals[c]);
    const Vec3d b = in_plane(minus(face.corners[(c + 2) % 3], here), face.normals[c]);
    return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

void append(std::vector<float>& to, const Vec3d& tangent, double sign) {
    for (const double x : tangent) to.push_back(static_cast<float>(x));
    to.push_back(static_cast<float>(sign));
}

}  // namespace

std::vector<float> derive_tangents(const Primitive& primitive, const std::vector<float>& uvs) {
    const std::size_t triangles = primitive.indices.size() / 3;
    std::map<Key, Vec3d> sums;
    for (std::size_t t = 0; t < triangles; ++t) {
        const Face face = face_at(primitive, uvs, t);
        if (face.along_u == Vec3d{0, 0, 0}) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            Vec3d& sum = sums.try_emplace(face.keys[c], Vec3d{0, 0, 0}).first->second;
            add_scaled(sum, in_plane(face.along_u, face.normals[c]), angle_at(face, c));
        }
    }
    std::vector<float> tangents;
    tangents.reserve(12 * triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
        const Face face = face_at(primitive, uvs, t);
        for (std::size_t c = 0; c < 3; ++c) {
            const auto found = sums.find(face.keys[c]);
            Vec3d tangent =
                found == sums.end() ? Vec3d{0, 0, 0} : in_plane(found->second, face.normals[c]);
            if (tangent == Vec3d{0, 0, 0}) tangent = across(face.normals[c]);
            append(tangents, tangent, face.handedness);
        }
    }
    return tangents;
}

std::vector<float> expand_tangents(
    const Primitive& primitive, const std::vector<float>& vertex_tangents) {
    std::vector<float> tangents;
    tangents.reserve(4 * primitive.indices.size());
    for (const uint32_t index : primitive.indices) {
        const float* t = &vertex_tangents[std::size_t{4} * index];
        Vec3d tangent = normalized({t[0], t[1], t[2]});
        if (tangent == Vec3d{0, 0, 0}) tangent = across(vec3_at(primitive.normals, index));
        append(tangents, tangent, t[3] < 0 ? -1 : 1);
    }
    return tangents;
}

}  // namespace wavepath
