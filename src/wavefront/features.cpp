#include "wavefront/features.h"

#include "scene/device_material.h"

#include <fmt/format.h>
#include <algorithm>

namespace wavepath {

std::string Features::defines() const {
    std::string text;
    const auto define = [&](const char* name, bool value) {
        text += fmt::format("#define {} {}\n", name, value ? 1 : 0);
    };
    define("HAS_VERTEX_NORMALS", vertex_normals);
    define("HAS_VERTEX_COLORS", vertex_colors);
    define("HAS_SPECULAR", specular);
    define("HAS_AREA_LIGHTS", area_lights);
    define("HAS_PUNCTUAL_LIGHTS", punctual_lights);
    define("HAS_ENVIRONMENT", environment);
    define("HAS_ENVIRONMENT_MAP", environment_map);
    define("HAS_MEDIA", media);
    define("HAS_DIELECTRICS", dielectrics);
    define("ROUGH_DIELECTRICS", rough_dielectrics);
    define("MEDIA_SCATTER", media_scatter);
    text += fmt::format("#define DISTANCES {}\n", static_cast<int>(distances));
    define("PHASE_DIRECTIONS", phase_directions);
    define("HAS_SPLITS", split_levels > 0);
    define("SAMPLE_LIGHTS", sample_lights);
    define("SAMPLE_LOBES", sample_lobes);
    define("WEIGH_BOTH", weigh_both);
    define("SAMPLER_SOBOL", sobol);
    text += fmt::format("#define RAYS_PER_ITEM {}\n", rays_per_item);
    return text;
}

Features features_of(
    const Scene& scene,
    const NormalisedScene& geometry,
    const LightTables& lights,
    const MediaTables& media,
    const Method& method,
    bool sobol) {
    Features f;
    f.vertex_normals = !geometry.normals.empty();
    f.vertex_colors = !geometry.colors.empty();
    f.specular = std::ranges::any_of(
        geometry.materials, [&](uint32_t m) { return reflects_specularly(scene.materials[m]); });
    f.area_lights =
        std::ranges::any_of(lights.triangle_lights, [](uint32_t row) { return row != NO_LIGHT; });
    f.punctual_lights = !geometry.lights.empty();
    f.environment = scene.environment.has_value();
    f.environment_map = f.environment && scene.environment->width > 0;
    f.media = !media.media.empty();
    f.media_scatter = media.scatter;
    f.dielectrics = media.refract;
    f.rough_dielectrics = media.refract_roughly;
    // Without a light that is somewhere there is no angle to draw distances from.
    const bool somewhere = std::ranges::any_of(lights.lights, [](const DeviceLight& light) {
        return light.kind == LIGHT_TRIANGLE || light.kind == LIGHT_POINT;
    });
    f.distances = !media.scatter ? Distances::exponential
                  : method.distances >= Distances::equiangular && !somewhere ? Distances::truncated
                                                                             : method.distances;
    f.phase_directions = method.phase_directions;
    f.sample_lights = method.sample_lights && !lights.lights.empty();
    f.sample_lobes = method.sample_lobes;
    f.weigh_both = method.weigh_both;
    f.sobol = sobol;
    return f;
}

}  // namespace wavepath
