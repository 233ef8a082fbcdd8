#include "prepare/prepared_scene.h"

#include "stopwatch.h"

#include <algorithm>

namespace wavepath {

namespace {

std::vector<bool> worn_materials(const Scene& scene, const NormalisedScene& geometry) {
    std::vector<bool> worn(scene.materials.size(), false);
    for (const uint32_t material : geometry.materials) worn[material] = true;
    return worn;
}

std::vector<bool> triangles_with_holes(const Scene& scene, const NormalisedScene& geometry) {
    std::vector<bool> holes;
    for (const uint32_t material : geometry.materials)
        holes.push_back(scene.materials[material].alpha_mode != AlphaMode::opaque);
    return holes;
}

bool has_glass(const Scene& scene, const PreparedScene& prepared) {
    for (std::size_t m = 0; m < prepared.worn.size(); ++m)
        if (prepared.worn[m] && scene.materials[m].boundary == Boundary::opaque &&
            scene.materials[m].transmission > 0)
            return true;
    return prepared.media.refract;
}

}  // namespace

bool PreparedScene::has_area_lights() const {
    return std::ranges::any_of(
        lights.triangle_lights, [](uint32_t row) { return row != NO_LIGHT && row != AT_LAMP; });
}

PreparedScene prepare(const Scene& scene, const Camera& camera, const Preparation& preparation) {
    PreparedScene out;
    Stopwatch watch;
    out.placed = place(scene, camera, preparation.width, preparation.height);
    const NormalisedScene& geometry = out.placed.geometry;
    Bvh& bvh = out.placed.bvh;
    std::vector<std::string>& warnings = out.placed.warnings;
    out.worn = worn_materials(scene, geometry);
    out.lights =
        build_light_tables(scene, geometry, preparation.light_choice, preparation.lights_alone);
    out.media = build_media_tables(scene, geometry);
    warnings.insert(warnings.end(), out.media.warnings.begin(), out.media.warnings.end());
    out.textures =
        build_texture_tables(scene, out.worn, preparation.page_bytes, preparation.texture_rows);
    if (preparation.aims) out.guide = guide_to_lights(scene, geometry, out.lights, out.media);
    out.normalise_seconds = watch.lap() - bvh.build_seconds;

    const std::vector<bool> holes = triangles_with_holes(scene, geometry);
    if (std::ranges::find(holes, true) == holes.end())
        out.mesh = small_mesh(geometry.positions);
    else
        mark_holes(bvh, holes);
    out.at_lamps = mark_lamp_contacts(scene, geometry, bvh, out.lights.triangle_lights);
    out.has_contacts = out.at_lamps.surfaces ||
                       (has_glass(scene, out) && wavepath::has_contacts(scene, geometry, bvh));
    out.bvh_seconds = bvh.build_seconds + watch.lap();
    return out;
}

}  // namespace wavepath
