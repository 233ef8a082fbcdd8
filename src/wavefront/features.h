// What a scene and a method need of the chain; kernels/shared/features.h is the other side.
#pragma once

#include "prepare/prepared_scene.h"
#include "scene/scene.h"
#include "wavefront/method.h"

#include <string>

namespace wavepath {

// Rays that one work-item of `intersect` and `occlusion` traces where they are traced in streams or
// packets.
constexpr uint32_t stream_rays = 128;

// With which kernels an estimator runs. The picture is the same, bit for bit.
enum class Kernels {
    specialised,    // the chain, each stage with what the scene needs
    full_features,  // the chain, each stage with all that leaves the scene's picture as it is
    megakernel,     // the stages of the chain in one kernel, which traces whole paths
};

struct Features {
    bool vertex_normals = false;
    bool vertex_colors = false;
    bool textures = false;  // of surfaces; emission and alpha are looked up where they are needed
    uint32_t uv_sets = 0;
    bool normal_maps = false;
    bool lobe_textures = false;
    bool emission_textures = false;
    bool alpha = false;
    bool vertex_alphas = false;
    uint32_t texture_pages = 0;
    uint64_t texture_page_words = 0;
    bool specular = false;
    bool has_layers = false;       // dielectrics with a specular layer,
    bool layers_conserve = false;  // which conserve energy
    bool transmission = false;
    bool smooth_walls = false;  // that light goes straight through
    bool area_lights = false;
    bool punctual_lights = false;
    bool environment = false;
    bool environment_map = false;
    bool media = false;
    bool media_scatter = false;
    bool dielectrics = false;        // boundaries that refract
    bool matched_media = false;      // besides index-matched ones
    bool tinted_boundaries = false;  // of index-matched ones
    bool contacts = false;           // something touches them or a lamp,
    bool lamp_contacts = false;      // a lamp,
    bool lamps_on_lamps = false;     // and itself shines to the same side
    bool far_geometry = false;       // triangles lie outside the unit cube
    bool far_camera = false;         // rays start at the scene
    bool rough_dielectrics = false;  // by microfacets
    // Boundaries that transmit in part and are opaque else.
    bool partial_boundaries = false;
    Distances distances = Distances::exponential;
    bool phase_directions = true;
    uint32_t split_levels = 0;  // vertices that branch
    bool sample_lights = false;
    bool sample_lobes = false;
    bool weigh_both = false;
    bool guide = false;
    bool sobol = true;
    uint32_t rays_per_item = 1;  // 1 or stream_rays
    bool ray_packets = false;    // of stream_rays, eight at a time against a small mesh
    bool megakernel = false;

    bool shading_normals() const { return vertex_normals || normal_maps; }
    // Surfaces that a ray may pass as the same ray.
    bool passages() const { return media || smooth_walls; }
    // Connections to lights that have to know what they meet, and those that need not.
    bool connections_by_hits() const { return sample_lights && (passages() || lamps_on_lamps); }
    bool connections_by_occlusion() const { return sample_lights && !connections_by_hits(); }

    // The #define lines that kernels/shared/features.h expects.
    std::string defines() const;
};

// What decides besides the scene.
struct FeatureSettings {
    Method method;
    Splits splits;
    uint32_t split_depth = 1;
    bool sobol = true;
    bool layers_conserve = true;
    bool far_camera = false;
    bool is_cpu = true;  // the device
    Kernels kernels = Kernels::specialised;
};

Features features_of(
    const Scene& scene, const PreparedScene& prepared, const FeatureSettings& settings);

}  // namespace wavepath
