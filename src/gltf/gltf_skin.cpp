#include "gltf/gltf_skin.h"

#include "gltf/gltf_accessor.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>

namespace wavepath {
namespace {

std::vector<Matrix4> inverse_bind_matrices(
    const GltfFile& file, const tinygltf::Skin& skin, std::string_view where) {
    std::vector<Matrix4> matrices(skin.joints.size(), identity_matrix);
    if (skin.inverseBindMatrices == -1) return matrices;
    const std::vector<float> rows = read_vectors(
        file, skin.inverseBindMatrices, 16, fmt::format("{}, inverseBindMatrices", where));
    if (rows.size() < 16 * matrices.size())
        file.fail(
            where, "has {} joints, but {} inverse bind matrices; export again", matrices.size(),
            rows.size() / 16);
    for (std::size_t joint = 0; joint < matrices.size(); ++joint)
        for (std::size_t column = 0; column < 4; ++column)  // the last row is 0 0 0 1
            for (std::size_t row = 0; row < 3; ++row)
                matrices[joint][4 * column + row] = rows[16 * joint + 4 * column + row];
    return matrices;
}

// The values of attribute `name`, four a vertex.
std::vector<float> read_set(
    const GltfFile& file,
    const tinygltf::Primitive& source,
    const std::string& name,
    std::size_t vertex_count,
    std::string_view where) {
    const auto found = source.attributes.find(name);
    if (found == source.attributes.end())
        file.fail(where, "its node has a skin, but it has no {}; export again", name);
    std::vector<float> values =
        read_vectors(file, found->second, 4, fmt::format("{}, {}", where, name));
    if (values.size() != 4 * vertex_count)
        file.fail(
            where, "{} has {} rows, POSITION has {}; repair the mesh and export again", name,
            values.size() / 4, vertex_count);
    return values;
}

// A weight of 0 makes its joint irrelevant, and some exporters leave rubbish there.
std::uint32_t checked_joint(
    const GltfFile& file,
    float joint,
    float weight,
    std::size_t joint_count,
    std::string_view where) {
    if (!(weight >= 0)) file.fail(where, "holds weight {}, below 0; export again", weight);
    if (weight == 0) return 0;
    if (!(joint >= 0 && joint < static_cast<float>(joint_count) && joint == std::floor(joint)))
        file.fail(
            where, "refers to joint {}, but the skin has {} of them; export again", joint,
            joint_count);
    return static_cast<std::uint32_t>(joint);
}

void normalize_weights(JointWeights& influences) {
    for (std::size_t first = 0; first < influences.weights.size(); first += influences.width) {
        const std::span weights(&influences.weights[first], influences.width);
        float sum = 0;
        for (const float weight : weights) sum += weight;
        if (sum > 0)
            for (float& weight : weights) weight /= sum;
        else
            weights[0] = 1;
    }
}

}  // namespace

std::vector<Matrix4> joint_matrices(
    const GltfFile& file,
    int index,
    std::span<const Matrix4* const> node_to_world,
    std::string_view node) {
    const tinygltf::Skin& skin = file.at(file.model.skins, index, "skin", node);
    const std::string where = label("skin", index, skin.name);
    if (skin.joints.empty()) file.fail(where, "has no joints; export again");
    std::vector<Matrix4> matrices = inverse_bind_matrices(file, skin, where);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        file.at(file.model.nodes, skin.joints[i], "node", where);
        const Matrix4* const to_world = node_to_world[static_cast<std::size_t>(skin.joints[i])];
        if (!to_world)
            file.fail(
                where, "its joint node {} is not in the scene of its mesh; add it or export again",
                skin.joints[i]);
        matrices[i] = multiply(*to_world, matrices[i]);
    }
    return matrices;
}

JointWeights read_joint_weights(
    const GltfFile& file,
    const tinygltf::Primitive& source,
    std::size_t vertex_count,
    std::size_t joint_count,
    std::string_view where) {
    std::size_t sets = 1;
    while (source.attributes.contains(fmt::format("JOINTS_{}", sets))) ++sets;
    JointWeights influences{4 * sets, {}, {}};
    influences.joints.resize(influences.width * vertex_count);
    influences.weights.resize(influences.width * vertex_count);
    for (std::size_t set = 0; set < sets; ++set) {
        const auto joints =
            read_set(file, source, fmt::format("JOINTS_{}", set), vertex_count, where);
        const auto weights =
            read_set(file, source, fmt::format("WEIGHTS_{}", set), vertex_count, where);
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const std::size_t at = influences.width * (i / 4) + 4 * set + i % 4;
            influences.joints[at] = checked_joint(file, joints[i], weights[i], joint_count, where);
            influences.weights[at] = weights[i];
        }
    }
    normalize_weights(influences);
    return influences;
}

void apply_skin(
    const GltfFile& file,
    Primitive& primitive,
    const JointWeights& influences,
    const std::vector<Matrix4>& joints,
    std::string_view where) {
    const auto store = [](std::vector<float>& to, std::size_t vertex, const Vec3d& value) {
        for (std::size_t k = 0; k < 3; ++k) to[3 * vertex + k] = static_cast<float>(value[k]);
    };
    for (std::size_t vertex = 0; vertex < primitive.positions.size() / 3; ++vertex) {
        Matrix4 blended{};
        for (std::size_t i = influences.width * vertex; i < influences.width * (vertex + 1); ++i)
            if (influences.weights[i] > 0)
                for (std::size_t k = 0; k < blended.size(); ++k)
                    blended[k] += static_cast<double>(influences.weights[i]) *
                                  joints[influences.joints[i]][k];
        const Vec3d position = transform_point(blended, vec3_at(primitive.positions, vertex));
        if (!std::ranges::all_of(position, [](double x) {
                return std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max());
            }))
            file.fail(where, "its skin moves vertex {} out of range; repair the joints", vertex);
        store(primitive.positions, vertex, position);
        if (!primitive.normals.empty())
            store(
                primitive.normals, vertex,
                transform_normal(blended, vec3_at(primitive.normals, vertex)));
    }
}

}  // namespace wavepath
