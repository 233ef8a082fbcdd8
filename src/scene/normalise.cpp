#include "scene/normalise.h"

#include "error.h"
#include "scene/corner_normals.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wavepath {

namespace {

// Twice the least area that counts: the square of a smaller normal leaves single precision.
constexpr double smallest_cross = 1e-18;

struct Bounds {
    Vec3d low{
        std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::infinity()};
    Vec3d high{
        -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()};

    void extend(const Vec3d& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
};

Bounds world_bounds(const Scene& scene) {
    Bounds bounds;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const uint32_t index : primitive.indices)
            bounds.extend(transform_point(instance.to_world, vec3_at(primitive.positions, index)));
    }
    return bounds;
}

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

// Appends `width` floats of `values` for each corner, of its vertex; `missing` where there are
// none.
void append_floats(
    std::vector<float>& to,
    const std::vector<float>& values,
    std::size_t width,
    const std::array<Corner, 3>& corners,
    float missing) {
    for (const Corner& corner : corners)
        for (std::size_t k = 0; k < width; ++k)
            to.push_back(values.empty() ? missing : values[width * corner.vertex + k]);
}

Vec3d transform_direction(const Matrix4& m, const Vec3d& d) {
    Vec3d r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = m[k] * d[0] + m[4 + k] * d[1] + m[8 + k] * d[2];
    return normalized(r);
}

// `face`: the normal of a triangle without vertex normals, normalised or not.
void append_normals(
    NormalisedScene& out,
    const Primitive& primitive,
    const Matrix4& to_world,
    const Vec3d& face,
    const std::array<Corner, 3>& corners) {
    if (primitive.normals.empty()) {
        for (std::size_t c = 0; c < 3; ++c) append(out.normals, normalized(face));
        return;
    }
    const std::array<Vec3d, 3> normals = corner_normals(primitive, corners[0].place / 3);
    for (const Corner& corner : corners)
        append(out.normals, transform_normal(to_world, normals[corner.place % 3]));
}

// A mirroring node turns bitangents round against normals and tangents.
void append_tangents(
    NormalisedScene& out,
    const Primitive& primitive,
    const Matrix4& to_world,
    bool mirrored,
    const std::array<Corner, 3>& corners) {
    for (const Corner& corner : corners) {
        const float* t =
            primitive.tangents.empty() ? nullptr : &primitive.tangents[4 * corner.place];
        append(out.tangents, t ? transform_direction(to_world, {t[0], t[1], t[2]}) : Vec3d{});
    }
    const float sign =
        primitive.tangents.empty() ? 1 : primitive.tangents[4 * corners[0].place + 3];
    out.bitangents.push_back(mirrored ? -sign : sign);
}

// Adds the triangles of one instance; corners are rounded to float first, as the device will see
// them.
void append_instance(
    NormalisedScene& out,
    const Primitive& primitive,
    const Matrix4& to_world,
    const Attributes& attributes) {
    const bool mirrored = dot(axis(to_world, 0), cross(axis(to_world, 1), axis(to_world, 2))) < 0;
    for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
        std::array<Corner, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) corners[c] = {primitive.indices[t + c], t + c};
        if (mirrored) std::swap(corners[1], corners[2]);
        std::array<Vec3d, 3> p;
        for (std::size_t c = 0; c < 3; ++c) {
            p[c] = out.to_normalised(
                transform_point(to_world, vec3_at(primitive.positions, corners[c].vertex)));
            for (double& x : p[c]) x = static_cast<float>(x);
        }
        const Vec3d face = face_cross(p);
        if (dot(face, face) < smallest_cross * smallest_cross) {
            ++out.dropped;
            continue;
        }
        for (const Vec3d& corner : p) append(out.positions, corner);
        out.materials.push_back(primitive.material);
        if (attributes.normals) append_normals(out, primitive, to_world, face, corners);
        if (attributes.colors) append_floats(out.colors, primitive.colors, 3, corners, 1);
        for (std::size_t k = 0; k < 2; ++k)
            if (attributes.uvs[k]) append_floats(out.uvs[k], primitive.uvs[k], 2, corners, 0);
        if (attributes.tangents) append_tangents(out, primitive, to_world, mirrored, corners);
        if (attributes.alphas) append_floats(out.alphas, primitive.alphas, 1, corners, 1);
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
std::string without_area(const Scene& scene, const Extent& extent) {
    const bool has_area = std::ranges::any_of(scene.primitives, [](const Primitive& primitive) {
        for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3)
            if (face_cross(
                    {vec3_at(primitive.positions, primitive.indices[t]),
                     vec3_at(primitive.positions, primitive.indices[t + 1]),
                     vec3_at(primitive.positions, primitive.indices[t + 2])}) != Vec3d{0, 0, 0})
                return true;
        return false;
    });
    const double distance = std::sqrt(dot(extent.centre, extent.centre));
    if (distance > 0x1p20 * extent.metres)
        return fmt::format(
            "every triangle is too small for its distance from the origin, {:.3g} m; move the "
            "scene there",
            distance);
    if (has_area)
        return fmt::format(
            "every triangle is too small for the scene's extent of {:.3g} m; remove what lies far "
            "away",
            extent.metres);
    return "every triangle has zero area; there is nothing to render";
}

}  // namespace

Vec3d NormalisedScene::to_normalised(const Vec3d& world) const {
    Vec3d p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = (world[k] - extent.centre[k]) / extent.metres;
    return p;
}

Extent extent_of(const Scene& scene) {
    const Bounds bounds = world_bounds(scene);
    Extent extent;
    extent.metres = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        extent.centre[k] = 0.5 * (bounds.low[k] + bounds.high[k]);
        extent.metres = std::max(extent.metres, bounds.high[k] - bounds.low[k]);
    }
    if (!std::isfinite(extent.metres) || extent.metres <= 0)
        throw Error(
            "{}: the scene's extent is {} m; give it triangles with an area", scene.name,
            extent.metres);
    return extent;
}

NormalisedScene normalise(const Scene& scene) {
    NormalisedScene out;
    out.extent = extent_of(scene);
    Attributes attributes;
    for (const Instance& instance : scene.instances)
        attributes.add(scene.primitives[instance.primitive]);
    for (const Instance& instance : scene.instances) {
        append_instance(out, scene.primitives[instance.primitive], instance.to_world, attributes);
        out.ends.push_back(static_cast<uint32_t>(out.triangle_count()));
    }
    if (out.materials.empty()) throw Error("{}: {}", scene.name, without_area(scene, out.extent));
    for (const PunctualLight& light : scene.lights)
        out.lights.push_back(normalised_light(out, light));
    return out;
}

}  // namespace wavepath
