#include "gltf/gltf_nodes.h"

#include "scene/transform.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
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
    auto matrix = transform_property<16>(file, where, "matrix", node.matrix, identity_matrix);
    for (std::size_t column = 0; column < 4; ++column) {
        constexpr double rounding = 1e-6;  // of products of single precision
        double& last = matrix[4 * column + 3];
        const double exact = column < 3 ? 0 : 1;
        if (!(std::abs(last - exact) <= rounding))
            file.fail(where, "the last row of matrix is not 0 0 0 1; export an affine transform");
        last = exact;
    }
    return matrix;
}

// A hidden node hides its whole subtree.
bool is_visible(const tinygltf::Node& node) {
    const auto* extension = find_extension(node.extensions, "KHR_node_visibility");
    if (!extension || !extension->Has("visible")) return true;
    return extension->Get("visible").Get<bool>();
}

// Walks the tree from its roots with a stack of its own: files decide how deep it is.
class TreeWalk {
  public:
    explicit TreeWalk(const GltfFile& file)
        : file_(file), has_parent_(file.model.nodes.size(), false) {}

    std::vector<PlacedNode> walk(const std::vector<int>& roots, std::string_view roots_label) {
        std::vector<PlacedNode> placed;
        push(roots, identity_matrix, true, roots_label);
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
            const bool visible = next.parent_visible && is_visible(node);
            placed.push_back({node, next.index, where, to_world, visible});
            push(node.children, to_world, visible, where);
        }
        return placed;
    }

  private:
    struct Pending {
        int index;
        Matrix4 parent_to_world;
        bool parent_visible;
    };

    const std::vector<tinygltf::Node>& nodes() const { return file_.model.nodes; }

    void push(
        const std::vector<int>& children,
        const Matrix4& to_world,
        bool visible,
        std::string_view parent) {
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
            pending_.push_back({*child, to_world, visible});
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

int scene_named(const GltfFile& file, const std::string& selector) {
    const std::vector<tinygltf::Scene>& scenes = file.model.scenes;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        if (scenes[i].name == selector) return static_cast<int>(i);
        names.push_back(label("scene", static_cast<int>(i), scenes[i].name));
    }
    std::size_t index = 0;
    const char* const end = selector.data() + selector.size();
    const auto [rest, error] = std::from_chars(selector.data(), end, index);
    if (error == std::errc{} && rest == end && index < scenes.size())
        return static_cast<int>(index);
    throw Error(
        "--scene {}: {} has {} scene(s){}{}; name one of them by index or name", selector,
        file.name, scenes.size(), names.empty() ? "" : ": ",
        one_line(fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace

std::vector<PlacedNode> place_nodes(const GltfFile& file, const std::string& selector) {
    const tinygltf::Model& model = file.model;
    if (!selector.empty() || !model.scenes.empty() || model.defaultScene != -1) {
        const int index =
            selector.empty() ? std::max(model.defaultScene, 0) : scene_named(file, selector);
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
