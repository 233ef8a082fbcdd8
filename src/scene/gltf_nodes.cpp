#include "scene/gltf_nodes.h"

#include "scene/transform.h"

#include <algorithm>
#include <cmath>

namespace wavepath {
namespace {

// Absent, or as many numbers as glTF says.
template <std::size_t N>
std::array<double, N> transform_property(
    const GltfFile& file,
    std::string_view where,
    const char* name,
    const std::vector<double>& values,
    const std::array<double, N>& missing) {
    if (values.empty()) return missing;
    if (values.size() != N)
        file.fail(where, "{} has {} numbers instead of {}; export again", name, values.size(), N);
    std::array<double, N> property;
    std::ranges::copy(values, property.begin());
    return property;
}

std::array<double, 4> rotation(
    const GltfFile& file, const tinygltf::Node& node, std::string_view where) {
    std::array<double, 4> quaternion =
        transform_property<4>(file, where, "rotation", node.rotation, {0, 0, 0, 1});
    const double length =
        std::hypot(std::hypot(quaternion[0], quaternion[1], quaternion[2]), quaternion[3]);
    if (!(length > 0)) file.fail(where, "rotation is the zero quaternion; export again");
    for (double& component : quaternion) component /= length;
    return quaternion;
}

Matrix4 local_transform(const GltfFile& file, const tinygltf::Node& node, std::string_view where) {
    if (node.matrix.empty())
        return compose(
            transform_property<3>(file, where, "translation", node.translation, {0, 0, 0}),
            rotation(file, node, where),
            transform_property<3>(file, where, "scale", node.scale, {1, 1, 1}));
    const auto matrix = transform_property<16>(file, where, "matrix", node.matrix, identity_matrix);
    if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1)
        file.fail(where, "the last row of matrix is not 0 0 0 1; export an affine transform");
    return matrix;
}

// Walks the tree from its roots with a stack of its own: files decide how deep it is.
class TreeWalk {
  public:
    explicit TreeWalk(const GltfFile& file)
        : file_(file), has_parent_(file.model.nodes.size(), false) {}

    std::vector<PlacedNode> walk(const std::vector<int>& roots, std::string_view roots_label) {
        std::vector<PlacedNode> placed;
        push(roots, identity_matrix, roots_label);
        while (!pending_.empty()) {
            const Pending next = pending_.back();
            pending_.pop_back();
            const tinygltf::Node& node = nodes()[static_cast<std::size_t>(next.index)];
            const std::string where = label("node", next.index, node.name);
            const Matrix4 to_world =
                multiply(next.parent_to_world, local_transform(file_, node, where));
            if (!is_finite(to_world))
                file_.fail(
                    where,
                    "its transform is not finite; repair it and its parents' or export again");
            placed.push_back({node, where, to_world});
            push(node.children, to_world, where);
        }
        return placed;
    }

  private:
    struct Pending {
        int index;
        Matrix4 parent_to_world;
    };

    const std::vector<tinygltf::Node>& nodes() const { return file_.model.nodes; }

    void push(const std::vector<int>& children, const Matrix4& to_world, std::string_view parent) {
        for (const int child : children) {
            file_.at(nodes(), child, "node", parent);
            if (has_parent_[static_cast<std::size_t>(child)])
                file_.fail(
                    parent,
                    "node {} is met a second time, nodes must form a tree; give each one parent",
                    child);
            has_parent_[static_cast<std::size_t>(child)] = true;
        }
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            pending_.push_back({*child, to_world});
    }

    const GltfFile& file_;
    std::vector<bool> has_parent_;  // or is a root
    std::vector<Pending> pending_;
};

std::vector<int> nodes_without_parent(const tinygltf::Model& model) {
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
                is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

}  // namespace

std::vector<PlacedNode> place_nodes(const GltfFile& file) {
    const tinygltf::Model& model = file.model;
    if (!model.scenes.empty() || model.defaultScene != -1) {
        const int index = std::max(model.defaultScene, 0);
        const tinygltf::Scene& scene = file.at(model.scenes, index, "scene", "default scene");
        return TreeWalk(file).walk(scene.nodes, label("scene", index, scene.name));
    }
    std::vector<PlacedNode> placed = TreeWalk(file).walk(nodes_without_parent(model), "nodes");
    if (placed.size() < model.nodes.size())
        file.fail(
            "nodes", "some are their own ancestors, nodes must form a tree; give each one parent");
    return placed;
}

}  // namespace wavepath
