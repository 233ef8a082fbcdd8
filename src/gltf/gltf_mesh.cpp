#include "gltf/gltf_mesh.h"

#include "gltf/gltf_accessor.h"
#include "gltf/gltf_attributes.h"
#include "gltf/gltf_skin.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace wavepath {
namespace {

// Corners in the order of [glTF 2.0, section 3.7.2.1], which keeps the winding of every other strip
// triangle. Vertices that do not complete a triangle are dropped, as rasterisers do.
std::vector<std::uint32_t> triangulate(int mode, std::vector<std::uint32_t> corners) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        corners.resize(corners.size() - corners.size() % 3);
        return corners;
    }
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            triangles.insert(
                triangles.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
        else
            triangles.insert(triangles.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
    return triangles;
}

// The area-weighted mean of the faces around each vertex; zero where they have no area.
std::vector<Vec3d> face_normals(const Primitive& primitive) {
    std::vector<Vec3d> normals(primitive.positions.size() / 3, Vec3d{0, 0, 0});
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const Vec3d a = vec3_at(primitive.positions, primitive.indices[i]);
        const Vec3d b = vec3_at(primitive.positions, primitive.indices[i + 1]);
        const Vec3d c = vec3_at(primitive.positions, primitive.indices[i + 2]);
        const Vec3d normal =
            cross({b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {c[0] - a[0], c[1] - a[1], c[2] - a[2]});
        for (std::size_t corner = i; corner < i + 3; ++corner)
            for (std::size_t k = 0; k < 3; ++k) normals[primitive.indices[corner]][k] += normal[k];
    }
    return normals;
}

// Quantized normals are unit only roughly, and exporters write zero ones for degenerate faces:
// those follow the faces around them.
void normalize_normals(Primitive& primitive) {
    constexpr Vec3d none{0, 0, 0};
    std::vector<Vec3d> replacements;
    for (std::size_t row = 0; row < primitive.normals.size() / 3; ++row) {
        Vec3d normal = normalized(vec3_at(primitive.normals, row));
        if (normal == none) {
            if (replacements.empty()) replacements = face_normals(primitive);
            normal = normalized(replacements[row]);
            if (normal == none) normal = {0, 0, 1};  // touches no area: never seen
        }
        std::ranges::transform(
            normal, primitive.normals.begin() + static_cast<std::ptrdiff_t>(3 * row),
            [](double x) { return static_cast<float>(x); });
    }
}

// One primitive and how messages call it: mesh 3 "lamp", primitive 0.
class PrimitiveReader {
  public:
    PrimitiveReader(
        const GltfFile& file,
        const tinygltf::Primitive& source,
        const Pose& pose,
        std::string where)
        : file_(file), source_(source), pose_(pose), where_(std::move(where)) {}

    Primitive read(std::uint32_t default_material) const {
        Primitive primitive;
        if (!pose_.weights.empty() && pose_.weights.size() != source_.targets.size())
            file_.fail(
                where_, "has {} morph targets, but {} weights; export again",
                source_.targets.size(), pose_.weights.size());
        primitive.positions = attribute("POSITION").value();
        const std::size_t vertex_count = primitive.positions.size() / 3;
        if (vertex_count > std::numeric_limits<std::uint32_t>::max())
            file_.fail(where_, "has more than 2^32 vertices; split the mesh");
        primitive.indices = triangulate(source_.mode, corners(vertex_count));
        primitive.normals = attribute("NORMAL", vertex_count).value_or(std::vector<float>{});
        if (!pose_.joints.empty())
            apply_skin(
                file_, primitive,
                read_joint_weights(file_, source_, vertex_count, pose_.joints.size(), where_),
                pose_.joints, where_);
        normalize_normals(primitive);
        primitive.colors = colors(vertex_count);
        primitive.material = material(default_material);
        return primitive;
    }

  private:
    // Three numbers a vertex, morphed.
    std::optional<std::vector<float>> attribute(
        const char* name, std::optional<std::size_t> vertex_count = std::nullopt) const {
        auto values = read_attribute(file_, source_, name, 3, vertex_count, where_);
        if (values) morph(name, *values);
        return values;
    }

    // value + sum of weight * displacement [glTF 2.0, section 3.7.2.2].
    void morph(const char* name, std::vector<float>& values) const {
        for (std::size_t target = 0; target < pose_.weights.size(); ++target) {
            const auto found = source_.targets[target].find(name);
            const double weight = pose_.weights[target];
            if (weight == 0 || found == source_.targets[target].end()) continue;
            const std::string where = fmt::format("{}, morph target {}, {}", where_, target, name);
            const std::vector<float> displacements = read_vectors(file_, found->second, 3, where);
            if (displacements.size() != values.size())
                file_.fail(
                    where, "has {} rows, the mesh {}; repair the mesh and export again",
                    displacements.size() / 3, values.size() / 3);
            for (std::size_t i = 0; i < values.size(); ++i) {
                const double moved =
                    static_cast<double>(values[i]) + weight * static_cast<double>(displacements[i]);
                if (!(std::abs(moved) <= static_cast<double>(std::numeric_limits<float>::max())))
                    file_.fail(
                        where, "weight {} moves row {} out of range; repair it", weight, i / 3);
                values[i] = static_cast<float>(moved);
            }
        }
    }

    std::vector<float> colors(std::size_t vertex_count) const {
        auto values = attribute("COLOR_0", vertex_count);
        if (!values) return {};
        const auto& accessor =
            file_.model.accessors[static_cast<std::size_t>(source_.attributes.at("COLOR_0"))];
        if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !accessor.normalized)
            file_.fail(where_, "COLOR_0 holds integers that are not normalized; export again");
        for (float& value : *values)
            value = std::clamp(value, 0.0F, 1.0F);  // [glTF 2.0, section 3.7.2.1]
        return *std::move(values);
    }

    std::vector<std::uint32_t> corners(std::size_t vertex_count) const {
        if (source_.indices != -1)
            return read_indices(file_, source_.indices, vertex_count, where_ + ", indices");
        std::vector<std::uint32_t> all(vertex_count);
        std::iota(all.begin(), all.end(), 0U);
        return all;
    }

    std::uint32_t material(std::uint32_t default_material) const {
        if (source_.material == -1) return default_material;
        file_.at(file_.model.materials, source_.material, "material", where_);
        return static_cast<std::uint32_t>(source_.material);
    }

    const GltfFile& file_;
    const tinygltf::Primitive& source_;
    const Pose& pose_;
    std::string where_;
};

bool makes_triangles(int mode) {
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

}  // namespace

std::vector<Primitive> read_mesh(
    const GltfFile& file,
    int index,
    const Pose& pose,
    const std::vector<Material>& materials,
    Ignored& ignored) {
    const auto default_material = static_cast<std::uint32_t>(materials.size() - 1);
    const tinygltf::Mesh& mesh = file.model.meshes[static_cast<std::size_t>(index)];
    std::vector<Primitive> primitives;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const tinygltf::Primitive& source = mesh.primitives[i];
        const std::string where =
            fmt::format("{}, primitive {}", label("mesh", index, mesh.name), i);
        if (source.mode < TINYGLTF_MODE_POINTS || source.mode > TINYGLTF_MODE_TRIANGLE_FAN)
            file.fail(where, "mode {} is unknown; export as triangles", source.mode);
        if (!makes_triangles(source.mode)) {
            ignored.add("primitives of points or lines", "left out");
            continue;
        }
        if (!source.attributes.contains("POSITION")) {
            ignored.add("primitives without POSITION", "left out");
            continue;
        }
        Primitive primitive = PrimitiveReader(file, source, pose, where).read(default_material);
        if (primitive.indices.empty()) continue;
        read_surface_attributes(
            file, source, materials[primitive.material], where,
            !pose.weights.empty() || !pose.joints.empty(), primitive, ignored);
        primitive.name = mesh.name.empty() ? label("mesh", index, "") : mesh.name;
        primitives.push_back(std::move(primitive));
    }
    return primitives;
}

}  // namespace wavepath
