#include "gltf/gltf_loader.h"

#include "gltf/gltf_file.h"
#include "gltf/gltf_ignored.h"
#include "gltf/gltf_instancing.h"
#include "gltf/gltf_material.h"
#include "gltf/gltf_medium.h"
#include "gltf/gltf_mesh.h"
#include "gltf/gltf_nodes.h"
#include "gltf/gltf_skin.h"
#include "gltf/gltf_texture.h"
#include "host_memory.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace wavepath {
namespace {

// Of host and device together while a scene with normals and colours is prepared on a CPU, measured
// (docs/gltf.md).
constexpr std::size_t bytes_a_triangle = 600;

// Instances of meshes, each read when a node first asks for it: the rest of the file costs nothing.
class MeshInstancer {
  public:
    MeshInstancer(
        const GltfFile& file, const std::vector<PlacedNode>& nodes, Scene& scene, Ignored& ignored)
        : file_(file),
          node_to_world_(file.model.nodes.size(), nullptr),
          scene_(scene),
          ignored_(ignored) {
        for (const PlacedNode& placed : nodes)
            node_to_world_[static_cast<std::size_t>(placed.index)] = &placed.to_world;
    }

    void place(const PlacedNode& placed) {
        const int mesh = placed.node.mesh;
        if (mesh == -1 || !placed.visible) return;
        Pose pose{weights(file_.at(file_.model.meshes, mesh, "mesh", placed.label), placed), {}};
        const std::vector<Matrix4> instances = placed.node.skin == -1
                                                   ? place_instances(file_, placed)
                                                   : std::vector<Matrix4>{bend(pose, placed)};
        const auto [first, last] = read(mesh, pose);
        check_memory(first, last, instances.size(), placed);
        for (const Matrix4& to_world : instances) {
            if (flattens_triangles(to_world)) continue;  // a scale of 0 is how files hide a mesh
            for (std::uint32_t primitive = first; primitive < last; ++primitive)
                scene_.instances.push_back({primitive, to_world, bodies_});
            ++bodies_;
        }
    }

  private:
    using Range = std::pair<std::uint32_t, std::uint32_t>;  // of Scene::primitives

    // Gives `pose` its joints; returns where the bent mesh is placed: joints alone move its
    // vertices, the transform of its node does not [glTF 2.0, section 3.7.3.3]. They are taken
    // relative to the first joint, as single precision is finer there than far from the origin.
    Matrix4 bend(Pose& pose, const PlacedNode& placed) const {
        pose.joints = joint_matrices(file_, placed.node.skin, node_to_world_, placed.label);
        const tinygltf::Skin& skin = file_.model.skins[static_cast<std::size_t>(placed.node.skin)];
        const Vec3d origin =
            axis(*node_to_world_[static_cast<std::size_t>(skin.joints.front())], 3);
        for (Matrix4& joint : pose.joints)
            for (std::size_t k = 0; k < 3; ++k) joint[12 + k] -= origin[k];
        return compose(origin, {0, 0, 0, 1}, {1, 1, 1});
    }

    // A node's weights are for its mesh alone.
    static std::vector<double> weights(const tinygltf::Mesh& mesh, const PlacedNode& placed) {
        std::vector<double> weights =
            placed.node.weights.empty() ? mesh.weights : placed.node.weights;
        const bool base_shape = std::ranges::all_of(weights, [](double w) { return w == 0; });
        return base_shape ? std::vector<double>{} : weights;
    }

    // Instances are expanded to triangles: the file's size bounds neither their number nor memory.
    void check_memory(
        std::uint32_t first, std::uint32_t last, std::size_t instances, const PlacedNode& placed) {
        std::size_t triangles = 0;
        for (std::uint32_t primitive = first; primitive < last; ++primitive)
            triangles += scene_.primitives[primitive].indices.size() / 3;
        triangles_ += triangles * instances;
        if (triangles_ > available_memory_ / bytes_a_triangle)
            file_.fail(
                placed.label,
                "brings the scene to {} triangles, which take {} MiB, and {} MiB are free; place "
                "fewer instances or use a machine with more memory",
                triangles_, triangles_ * bytes_a_triangle >> 20U, available_memory_ >> 20U);
    }

    Range read(int mesh, const Pose& pose) {
        const auto [known, is_new] = read_.try_emplace({mesh, pose});
        if (!is_new) return known->second;
        const auto first = static_cast<std::uint32_t>(scene_.primitives.size());
        for (Primitive& primitive : read_mesh(file_, mesh, pose, scene_.materials, ignored_))
            scene_.primitives.push_back(std::move(primitive));
        return known->second = {first, static_cast<std::uint32_t>(scene_.primitives.size())};
    }

    const GltfFile& file_;
    std::vector<const Matrix4*> node_to_world_;  // by node; null: not in the scene
    Scene& scene_;
    Ignored& ignored_;
    std::size_t triangles_ = 0;  // instances expanded
    std::size_t available_memory_ = available_memory();
    std::map<std::pair<int, Pose>, Range> read_;
    std::uint32_t bodies_ = 0;
};

void note_ignored_features(const tinygltf::Model& model, Ignored& ignored) {
    ignored.add("animations", "rendered at rest", model.animations.size());
}

// A material that nothing wears must not decide which lobes the kernels are built with.
void drop_default_material_if_unused(Scene& scene) {
    const std::size_t default_material = scene.materials.size() - 1;
    const bool used = std::ranges::any_of(scene.primitives, [&](const Primitive& primitive) {
        return primitive.material == default_material;
    });
    if (!used) scene.materials.pop_back();
}

std::vector<std::string> ignored_extensions(const tinygltf::Model& model) {
    std::vector<std::string> lines;
    for (const std::string& extension : model.extensionsUsed)
        if (!is_supported_extension(extension))
            lines.push_back(
                fmt::format("{}: not supported, rendered without it", one_line(extension)));
    std::ranges::sort(lines);
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
}

// Blender's exporter means lumens unless told otherwise: its lamps are then this bright, and few
// that are meant in watts are. [W/m^2] and [W/sr] of docs/conventions.md.
bool looks_photometric(const PunctualLight& light) {
    const float brightest = std::ranges::max(light.intensity);
    return light.kind == LightKind::directional ? brightest >= 100 : brightest >= 300;
}

void scale_lights(Scene& scene, const std::string& generator, double lumens_per_watt) {
    if (lumens_per_watt == 1 && generator.find("Blender") != std::string::npos &&
        std::ranges::any_of(scene.lights, looks_photometric))
        scene.ignored.emplace_back(
            "lights this bright from Blender are in lumens as a rule; if the picture is white, "
            "export "
            "in lighting mode Unitless, or, if the mode was Standard, use --lumens-per-watt 683");
    for (PunctualLight& light : scene.lights)
        for (float& channel : light.intensity) {
            channel = static_cast<float>(double{channel} / lumens_per_watt);
            if (!std::isfinite(channel))
                throw Error(
                    "--lumens-per-watt {}: light \"{}\" is brighter than floats can say; raise it",
                    lumens_per_watt, one_line(light.name));
        }
}

}  // namespace

Scene load_gltf(
    const std::filesystem::path& path,
    const std::string& selector,
    uint64_t most_texels,
    double lumens_per_watt) {
    const GltfFile file = read_gltf_file(path);
    Scene scene;
    scene.name = path.string();
    scene.files = file.files;

    Ignored ignored;
    scene.materials = read_materials(file, ignored);
    note_ignored_features(file.model, ignored);
    note_misplaced_media(file.model, ignored);
    const std::vector<PlacedNode> nodes = place_nodes(file, selector);
    MeshInstancer meshes(file, nodes, scene, ignored);
    for (const PlacedNode& placed : nodes) {
        meshes.place(placed);
        if (auto camera = read_camera(file, placed)) scene.cameras.push_back(*std::move(camera));
        if (!placed.visible) continue;
        if (auto light = read_light(file, placed)) scene.lights.push_back(*std::move(light));
    }
    if (scene.triangle_count() == 0)
        file.fail(
            selector.empty() ? "default scene" : fmt::format("scene {}", selector),
            "holds no triangles; add a mesh to it or choose another {}",
            file.model.scenes.size() > 1 ? "--scene" : "file");

    load_images(file, scene, most_texels);
    drop_default_material_if_unused(scene);
    scene.ignored = ignored.lines();
    std::ranges::move(ignored_extensions(file.model), std::back_inserter(scene.ignored));
    scale_lights(scene, file.model.asset.generator, lumens_per_watt);
    return scene;
}

}  // namespace wavepath
