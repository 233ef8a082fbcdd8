#include "scene/gltf_loader.h"

#include "scene/gltf_file.h"
#include "scene/gltf_ignored.h"
#include "scene/gltf_material.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_texture.h"
#include "scene/transform.h"

#include <algorithm>
#include <map>

namespace wavepath {
namespace {

// Instances of meshes, each read when a node first asks for it: the rest of the file costs nothing.
class MeshInstancer {
  public:
    MeshInstancer(const GltfFile& file, Scene& scene, Ignored& ignored)
        : file_(file), scene_(scene), ignored_(ignored) {}

    void place(const PlacedNode& placed) {
        const int mesh = placed.node.mesh;
        if (mesh == -1) return;
        file_.at(file_.model.meshes, mesh, "mesh", placed.label);
        const auto [first, last] = primitives_of(mesh);
        // A scale of 0 is how files hide a mesh.
        if (flattens_triangles(placed.to_world)) return;
        for (std::uint32_t primitive = first; primitive < last; ++primitive)
            scene_.instances.push_back({primitive, placed.to_world});
    }

  private:
    using Range = std::pair<std::uint32_t, std::uint32_t>;  // of Scene::primitives

    Range primitives_of(int mesh) {
        if (const auto known = read_.find(mesh); known != read_.end()) return known->second;
        const auto first = static_cast<std::uint32_t>(scene_.primitives.size());
        for (Primitive& primitive : read_mesh(file_, mesh, scene_.materials, ignored_))
            scene_.primitives.push_back(std::move(primitive));
        return read_[mesh] = {first, static_cast<std::uint32_t>(scene_.primitives.size())};
    }

    const GltfFile& file_;
    Scene& scene_;
    Ignored& ignored_;
    std::map<int, Range> read_;
};

void note_ignored_features(const tinygltf::Model& model, Ignored& ignored) {
    ignored.add("skins", "rendered in the rest pose", model.skins.size());
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

}  // namespace

Scene load_gltf(const std::filesystem::path& path, uint64_t most_texels) {
    const GltfFile file = read_gltf_file(path);
    Scene scene;
    scene.name = path.stem().string();
    scene.materials = read_materials(file);

    Ignored ignored;
    note_ignored_features(file.model, ignored);
    MeshInstancer meshes(file, scene, ignored);
    for (const PlacedNode& placed : place_nodes(file)) {
        meshes.place(placed);
        if (auto camera = read_camera(file, placed)) scene.cameras.push_back(*std::move(camera));
        if (auto light = read_light(file, placed)) scene.lights.push_back(*std::move(light));
    }
    if (scene.triangle_count() == 0)
        file.fail("default scene", "holds no triangles; add a mesh to it or choose another file");

    load_images(file, scene, most_texels);
    drop_default_material_if_unused(scene);
    scene.ignored = ignored.lines();
    std::ranges::move(ignored_extensions(file.model), std::back_inserter(scene.ignored));
    return scene;
}

}  // namespace wavepath
