#include "gltf/gltf_instancing.h"

#include "gltf/gltf_accessor.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>

namespace wavepath {
namespace {

constexpr const char* extension_name = "EXT_mesh_gpu_instancing";

// The attributes of a node's instances: as many rows of each.
class InstanceAttributes {
  public:
    InstanceAttributes(
        const GltfFile& file, const PlacedNode& placed, const tinygltf::Value& object)
        : file_(file), placed_(placed), attributes_(object.Get("attributes")) {
        if (!attributes_.IsObject() || attributes_.Keys().empty())
            file.fail(placed.label, "{} has no attributes; export again", extension_name);
    }

    std::vector<float> read(const char* name, std::size_t width) {
        if (!attributes_.Has(name)) return {};
        const std::string where = fmt::format("{}, instances' {}", placed_.label, name);
        std::vector<float> rows =
            read_vectors(file_, integer(file_, where, attributes_, name), width, where);
        if (count_ > 0 && rows.size() / width != count_)
            file_.fail(
                where, "has {} rows, another attribute {}; repair the instances or export again",
                rows.size() / width, count_);
        count_ = rows.size() / width;
        return rows;
    }

    std::size_t count() const { return count_; }

  private:
    const GltfFile& file_;
    const PlacedNode& placed_;
    const tinygltf::Value& attributes_;
    std::size_t count_ = 0;
};

template <std::size_t N>
std::array<double, N> row_or(
    const std::vector<float>& rows, std::size_t row, const std::array<double, N>& missing) {
    if (rows.empty()) return missing;
    std::array<double, N> values;
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(N * row), N, values.begin());
    return values;
}

}  // namespace

std::vector<Matrix4> place_instances(const GltfFile& file, const PlacedNode& placed) {
    const auto* extension = find_extension(placed.node.extensions, extension_name);
    if (!extension) return {placed.to_world};

    InstanceAttributes attributes(file, placed, *extension);
    const std::vector<float> translations = attributes.read("TRANSLATION", 3);
    const std::vector<float> rotations = attributes.read("ROTATION", 4);
    const std::vector<float> scales = attributes.read("SCALE", 3);
    if (attributes.count() == 0) return {placed.to_world};  // attributes of an application's own

    std::vector<Matrix4> instances;
    instances.reserve(attributes.count());
    for (std::size_t i = 0; i < attributes.count(); ++i) {
        std::array<double, 4> rotation = row_or<4>(rotations, i, {0, 0, 0, 1});
        const double length =
            std::hypot(std::hypot(rotation[0], rotation[1], rotation[2]), rotation[3]);
        if (!(length > 0))
            file.fail(placed.label, "instance {} has the zero quaternion; export again", i);
        for (double& component : rotation) component /= length;
        instances.push_back(multiply(
            placed.to_world,
            compose(
                row_or<3>(translations, i, {0, 0, 0}), rotation, row_or<3>(scales, i, {1, 1, 1}))));
        if (!is_finite(instances.back()))
            file.fail(placed.label, "the transform of instance {} is not finite; repair it", i);
    }
    return instances;
}

}  // namespace wavepath
