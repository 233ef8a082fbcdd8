// What a scene and a method need of the chain; kernels/shared/features.h is the other side.
#pragma once

#include "scene/light_tables.h"
#include "scene/media_tables.h"
#include "scene/normalise.h"
#include "scene/scene.h"
#include "wavefront/method.h"

#include <string>

namespace wavepath {

struct Features {
    bool vertex_normals = false;
    bool vertex_colors = false;
    bool specular = false;
    bool area_lights = false;
    bool punctual_lights = false;
    bool environment = false;
    bool environment_map = false;
    bool media = false;
    bool media_scatter = false;
    bool dielectrics = false;        // boundaries that refract
    bool rough_dielectrics = false;  // and by microfacets
    Distances distances = Distances::exponential;
    bool phase_directions = true;
    uint32_t split_levels = 0;  // vertices that branch; the renderer's to decide
    bool sample_lights = false;
    bool sample_lobes = false;
    bool weigh_both = false;
    bool sobol = true;
    uint32_t rays_per_item = 1;  // that a work-item of intersect and occlusion traces

    // The #define lines that kernels/shared/features.h expects.
    std::string defines() const;
};

Features features_of(
    const Scene& scene,
    const NormalisedScene& geometry,
    const LightTables& lights,
    const MediaTables& media,
    const Method& method,
    bool sobol);

}  // namespace wavepath
