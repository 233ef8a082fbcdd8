#include "prepare/normalise.h"

#include "error.h"
#include "prepare/subdivide.h"
#include "scene/corner_normals.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace wavepath {

namespace {

// Twice the least area that counts: the square of a smaller normal leaves single precision.
constexpr double smallest_cross = 1e-18;

// Its length is twice the triangle's area.
Vec3d face_cross(const std::array<Vec3d, 3>& p) {
    const Vec3d u{p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]};
    const Vec3d v{p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
    return cross(u, v);
}

void append(std::vector<float>& to, const Vec3d& v) {
    for (const double x : v) to.push_back(static_cast<float>(x));
}

// What some triangle of the scene has, and so all of them.
struct Attributes {
    bool normals = false, colors = false, tangents = false, alphas = false;
    std::array<bool, 2> uvs{};

    void add(const Primitive& primitive) {
        normals = normals || !primitive.normals.empty();
        colors = colors || !primitive.colors.empty();
        tangents = tangents || !primitive.tangents.empty();
        alphas = alphas || !primitive.alphas.empty();
        for (std::size_t k = 0; k < 2; ++k) uvs[k] = uvs[k] || !primitive.uvs[k].empty();
    }
};

// A corner of a triangle: its vertex, and where it stands in Primitive::indices.
struct Corner {
    uint32_t vertex;
    std::size_t place;
};

// A triangle as the file has it.
struct Source {
    const Primitive& primitive;
    const Matrix4& to_world;
    bool mirrored;
    std::array<Corner, 3> corners;
};

// What corners of these values have at barycentric `weights`; a corner's own bits at the corner.
double blend(const Vec3d& weights, const Vec3d& values) {
    double sum = -0.0;
    for (std::size_t k = 0; k < 3; ++k)
        if (weights[k] != 0) sum += weights[k] * values[k];
    return sum;
}

Vec3d blend(const Vec3d& weights, const std::array<Vec3d, 3>& values) {
    Vec3d sum;
    for (std::size_t k = 0; k < 3; ++k)
        sum[k] = blend(weights, Vec3d{values[0][k], values[1][k], values[2][k]});
    return sum;
}

// Appends `width` floats of `values` for each corner of the piece; `missing` where there are none.
void append_floats(
    std::vector<float>& to,
    const std::vector<float>& values,
    std::size_t width,
    const Source& source,
    const Piece& piece,
    float missing) {
    const auto at = [&](std::size_t corner, std::size_t k) {
        return double{values[width * source.corners[corner].vertex + k]};
    };
    for (const PieceCorner& corner : piece)
        for (std::size_t k = 0; k < width; ++k)
            to.push_back(
                values.empty() ? missing
                               : static_cast<float>(
                                     blend(corner.weights, Vec3d{at(0, k), at(1, k), at(2, k)})));
}

Vec3d transform_direction(const Matrix4& m, const Vec3d& d) {
    Vec3d r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = m[k] * d[0] + m[4 + k] * d[1] + m[8 + k] * d[2];
    return normalized(r);
}

// A mirroring node turns bitangents round against normals and tangents.
void append_tangents(NormalisedScene& out, const Source& source, const Piece& piece) {
    const std::vector<float>& all = source.primitive.tangents;
    std::array<Vec3d, 3> tangents{};
    for (std::size_t c = 0; !all.empty() && c < 3; ++c) {
        const float* t = &all[4 * source.corners[c].place];
        tangents[c] = transform_direction(source.to_world, {t[0], t[1], t[2]});
    }
    for (const PieceCorner& corner : piece) append(out.tangents, blend(corner.weights, tangents));
    const float sign = all.empty() ? 1 : all[4 * source.corners[0].place + 3];
    out.bitangents.push_back(source.mirrored ? -sign : sign);
}

void append_normals(
    NormalisedScene& out, const Source& source, const Piece& piece, const Vec3d& face) {
    std::array<Vec3d, 3> normals{face, face, face};
    if (!source.primitive.normals.empty()) {
        const auto stored = corner_normals(source.primitive, source.corners[0].place / 3);
        for (std::size_t c = 0; c < 3; ++c)
            normals[c] = transform_normal(source.to_world, stored[source.corners[c].place % 3]);
    }
    for (const PieceCorner& corner : piece) append(out.normals, blend(corner.weights, normals));
}

// Whether it has a shape but for rounding in double.
bool has_area(const Piece& piece) {
    const std::array<Vec3d, 3> p{piece[0].position, piece[1].position, piece[2].position};
    const Vec3d face = face_cross(p);
    double longest2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d edge = minus(p[(k + 1) % 3], p[k]);
        longest2 = std::max(longest2, dot(edge, edge));
    }
    return std::sqrt(dot(face, face)) > 1e-6 * longest2;
}

// Corners are rounded to float first, as the device will see them.
void append_piece(
    NormalisedScene& out, const Source& source, const Piece& piece, const Attributes& attributes) {
    const Primitive& primitive = source.primitive;
    std::array<Vec3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) p[c][k] = static_cast<float>(piece[c].position[k]);
    const Vec3d face = face_cross(p);
    if (dot(face, face) < smallest_cross * smallest_cross) {
        ++out.dropped;
        if (has_area(piece)) ++out.lost;
        return;
    }
    for (const Vec3d& corner : p) {
        append(out.positions, corner);
        out.reach = std::max(out.reach, std::sqrt(dot(corner, corner)));
    }
    out.materials.push_back(primitive.material);
    if (attributes.normals) append_normals(out, source, piece, normalized(face));
    if (attributes.colors) append_floats(out.colors, primitive.colors, 3, source, piece, 1);
    for (std::size_t k = 0; k < 2; ++k)
        if (attributes.uvs[k]) append_floats(out.uvs[k], primitive.uvs[k], 2, source, piece, 0);
    if (attributes.tangents) append_tangents(out, source, piece);
    if (attributes.alphas) append_floats(out.alphas, primitive.alphas, 1, source, piece, 1);
}

bool lies_in_unit_cube(const std::array<Vec3d, 3>& corners) {
    return std::ranges::all_of(corners, [](const Vec3d& p) {
        return std::ranges::all_of(p, [](double x) { return std::abs(x) <= 0.5; });
    });
}

// Adds the triangles of one instance.
void append_instance(
    NormalisedScene& out,
    const Primitive& primitive,
    const Matrix4& to_world,
    const Attributes& attributes) {
    const bool mirrored = dot(axis(to_world, 0), cross(axis(to_world, 1), axis(to_world, 2))) < 0;
    for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
        Source source{primitive, to_world, mirrored, {}};
        for (std::size_t c = 0; c < 3; ++c) source.corners[c] = {primitive.indices[t + c], t + c};
        if (mirrored) std::swap(source.corners[1], source.corners[2]);
        std::array<Vec3d, 3> p;
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = out.to_normalised(
                transform_point(to_world, vec3_at(primitive.positions, source.corners[c].vertex)));
        if (lies_in_unit_cube(p)) {
            append_piece(out, source, whole(p), attributes);
            continue;
        }
        for (const Piece& piece : pieces_of(p)) append_piece(out, source, piece, attributes);
    }
}

PunctualLight normalised_light(const NormalisedScene& space, PunctualLight light) {
    light.position = space.to_normalised(light.position);
    light.range /= space.extent.metres;
    if (light.kind != LightKind::directional)
        for (float& channel : light.intensity)
            channel = static_cast<float>(channel / (space.extent.metres * space.extent.metres));
    return light;
}

// Why no triangle of the scene counts.
std::string without_area(const Extent& extent) {
    const double distance = std::sqrt(dot(extent.centre, extent.centre));
    if (distance > 0x1p20 * extent.metres)
        return fmt::format(
            "every triangle is too small for its distance from the origin, {:.3g} m; move the "
            "scene there",
            distance);
    return "every triangle has zero area; there is nothing to render";
}

}  // namespace

Vec3d NormalisedScene::to_normalised(const Vec3d& world) const {
    Vec3d p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = (world[k] - extent.centre[k]) / extent.metres;
    return p;
}

std::array<Vec3d, 3> NormalisedScene::corners_of(std::size_t triangle) const {
    return {
        vec3_at(positions, 3 * triangle), vec3_at(positions, 3 * triangle + 1),
        vec3_at(positions, 3 * triangle + 2)};
}

double coarseness_at(const Vec3d& p) {
    return std::max({1.0, 2 * std::abs(p[0]), 2 * std::abs(p[1]), 2 * std::abs(p[2])});
}

NormalisedScene normalise(const Scene& scene) {
    return normalise(scene, extent_of(scene));
}

NormalisedScene normalise(const Scene& scene, const Extent& extent) {
    NormalisedScene out;
    out.extent = extent;
    Attributes attributes;
    for (const Instance& instance : scene.instances)
        attributes.add(scene.primitives[instance.primitive]);
    for (const Instance& instance : scene.instances) {
        append_instance(out, scene.primitives[instance.primitive], instance.to_world, attributes);
        out.ends.push_back(static_cast<uint32_t>(out.triangle_count()));
    }
    if (out.materials.empty() && out.lost == 0)
        throw Error("{}: {}", scene.name, without_area(out.extent));
    for (const PunctualLight& light : scene.lights)
        out.lights.push_back(normalised_light(out, light));
    return out;
}

}  // namespace wavepath
