#include "wavefront/features.h"

#include "prepare/device_material.h"

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
    define("HAS_TEXTURES", textures);
    text += fmt::format("#define UV_SETS {}\n", uv_sets);
    define("HAS_NORMAL_MAPS", normal_maps);
    define("HAS_LOBE_TEXTURES", lobe_textures);
    define("HAS_EMISSION_TEXTURES", emission_textures);
    define("HAS_ALPHA", alpha);
    define("HAS_VERTEX_ALPHAS", vertex_alphas);
    text += fmt::format("#define TEXTURE_PAGES {}\n", texture_pages);
    text += fmt::format("#define TEXTURE_PAGE_WORDS {}u\n", texture_page_words);
    define("HAS_SPECULAR", specular);
    define("LAYERS_CONSERVE", layers_conserve);
    define("HAS_TRANSMISSION", transmission);
    define("HAS_SMOOTH_WALLS", smooth_walls);
    define("HAS_AREA_LIGHTS", area_lights);
    define("HAS_PUNCTUAL_LIGHTS", punctual_lights);
    define("HAS_ENVIRONMENT", environment);
    define("HAS_ENVIRONMENT_MAP", environment_map);
    define("HAS_MEDIA", media);
    define("HAS_DIELECTRICS", dielectrics);
    define("HAS_MATCHED_MEDIA", matched_media);
    define("TINTED_BOUNDARIES", tinted_boundaries);
    define("HAS_CONTACTS", contacts);
    define("HAS_LAMP_CONTACTS", lamp_contacts);
    define("LAMPS_ON_LAMPS", lamps_on_lamps);
    define("HAS_FAR_GEOMETRY", far_geometry);
    define("HAS_FAR_CAMERA", far_camera);
    define("ROUGH_DIELECTRICS", rough_dielectrics);
    define("PARTIAL_BOUNDARIES", partial_boundaries);
    define("MEDIA_SCATTER", media_scatter);
    text += fmt::format("#define DISTANCES {}\n", static_cast<int>(distances));
    define("PHASE_DIRECTIONS", phase_directions);
    define("HAS_SPLITS", split_levels > 0);
    define("SAMPLE_LIGHTS", sample_lights);
    define("SAMPLE_LOBES", sample_lobes);
    define("WEIGH_BOTH", weigh_both);
    define("HAS_GUIDE", guide);
    define("SAMPLER_SOBOL", sobol);
    text += fmt::format("#define RAYS_PER_ITEM {}\n", rays_per_item);
    define("RAY_PACKETS", ray_packets);
    return text;
}

namespace {

// On a CPU a tree that outgrows the caches is traversed by many rays in turn, so that they wait for
// memory together.
constexpr std::size_t stream_nodes = 1024;

void add_materials(Features& f, const Scene& scene, const std::vector<bool>& worn) {
    for (std::size_t m = 0; m < worn.size(); ++m) {
        if (!worn[m]) continue;
        const Material& material = scene.materials[m];
        const bool lobes = has_lobes(material);
        f.specular = f.specular || lobes;
        f.has_layers = f.has_layers || has_layer(material);
        f.lobe_textures =
            f.lobe_textures ||
            (lobes && (material.has(TEXTURE_METALLIC_ROUGHNESS) || material.has(TEXTURE_SPECULAR) ||
                       material.has(TEXTURE_SPECULAR_COLOR) || material.has(TEXTURE_TRANSMISSION)));
        f.textures = f.textures || (!material.unlit && material.has(TEXTURE_BASE_COLOR));
        f.emission_textures =
            f.emission_textures ||
            (material.emits() && (material.has(TEXTURE_EMISSION) || material.unlit));
        f.transmission =
            f.transmission || (material.boundary == Boundary::opaque && material.transmission > 0);
        f.smooth_walls = f.smooth_walls || may_pass_straight(material);
        f.partial_boundaries = f.partial_boundaries || material.transmits_in_part();
        f.alpha = f.alpha || material.alpha_mode != AlphaMode::opaque;
        f.tinted_boundaries =
            f.tinted_boundaries || (material.boundary == Boundary::index_matched &&
                                    (f.vertex_colors || has_tint(material)));
    }
}

void add_geometry(Features& f, const NormalisedScene& geometry) {
    f.vertex_normals = !geometry.normals.empty();
    f.vertex_colors = !geometry.colors.empty();
    f.normal_maps = !geometry.tangents.empty();
    f.uv_sets = (geometry.uvs[0].empty() ? 0U : 1U) + (geometry.uvs[1].empty() ? 0U : 1U);
    f.vertex_alphas = !geometry.alphas.empty();
    f.far_geometry = geometry.is_far();
    f.punctual_lights = !geometry.lights.empty();
}

void add_media(Features& f, const MediaTables& media) {
    f.media = !media.media.empty();
    f.media_scatter = media.scatter;
    f.dielectrics = media.refract;
    f.matched_media = std::ranges::any_of(
        media.media, [](const DeviceMedium& medium) { return medium.ior == 0; });
    f.rough_dielectrics = media.refract_roughly;
}

// Methods that differ in nothing here share their kernels, which are compiled once.
void add_method(Features& f, const LightTables& lights, const Method& method) {
    // Without a light that is somewhere there is no angle to draw distances from.
    const bool somewhere = std::ranges::any_of(lights.lights, [](const DeviceLight& light) {
        return light.kind == LIGHT_TRIANGLE || light.kind == LIGHT_POINT;
    });
    f.distances = !f.media_scatter ? Distances::exponential
                  : method.distances >= Distances::equiangular && !somewhere ? Distances::truncated
                                                                             : method.distances;
    f.phase_directions = method.phase_directions || !f.media_scatter;
    f.sample_lights = method.sample_lights && !lights.lights.empty();
    f.sample_lobes = method.sample_lobes && f.specular;
    f.weigh_both = method.weigh_both && f.sample_lights;
}

bool branches(const Features& f, const Splits& splits) {
    return splits.reflections > 1 ||
           (f.media_scatter && (splits.directions > 1 || f.distances != Distances::exponential));
}

void add_traversal(Features& f, const PreparedScene& prepared, const FeatureSettings& settings) {
    f.contacts = prepared.has_contacts;
    f.lamp_contacts = prepared.at_lamps.surfaces;
    f.lamps_on_lamps = prepared.at_lamps.lamps;
    f.megakernel = settings.kernels == Kernels::megakernel;
    if (f.megakernel || !settings.is_cpu) return;
    f.ray_packets = prepared.mesh.has_value();
    if (f.ray_packets || prepared.placed.bvh.nodes.size() >= stream_nodes)
        f.rays_per_item = stream_rays;
}

// Turns on what leaves every bit of a picture as it is. Not so: vertex attributes and maps, which
// the scene has no data of; media and splits, which number random dimensions differently; lobes,
// whose samples are weighed by a quotient where a diffuse surface's are by its base; contacts, far
// geometry and far cameras, which start rays elsewhere; boundaries that transmit in part, whose
// materials come in two; and what says which estimator it is.
void turn_on_the_rest(Features& f) {
    f.textures = f.emission_textures = f.alpha = true;
    f.lobe_textures = f.specular;
    f.transmission = f.transmission || (f.specular && !f.guide);  // guides are for opaque walls
    f.smooth_walls = true;
    f.area_lights = f.punctual_lights = f.environment = true;
    f.matched_media = f.rough_dielectrics = true;
}

}  // namespace

Features features_of(
    const Scene& scene, const PreparedScene& prepared, const FeatureSettings& settings) {
    Features f;
    add_geometry(f, prepared.geometry());
    add_materials(f, scene, prepared.worn);
    f.layers_conserve = f.has_layers && settings.layers_conserve;
    f.textures = f.textures || f.lobe_textures || f.normal_maps;
    f.texture_pages = prepared.textures.pages();
    f.texture_page_words = prepared.textures.page_words;
    f.area_lights = prepared.has_area_lights();
    f.environment = scene.environment.has_value();
    f.environment_map = f.environment && scene.environment->width > 0;
    add_media(f, prepared.media);
    add_method(f, prepared.lights, settings.method);
    f.guide = f.weigh_both && !f.transmission && prepared.guide.has_value();
    f.split_levels = branches(f, settings.splits) ? settings.split_depth : 0;
    f.far_camera = settings.far_camera;
    f.sobol = settings.sobol;
    add_traversal(f, prepared, settings);
    if (settings.kernels == Kernels::full_features) turn_on_the_rest(f);
    return f;
}

}  // namespace wavepath
