#include "wavefront/render_params.h"

#include "prepare/camera_params.h"
#include "shared/queues.h"

namespace wavepath {

namespace {

void set_surroundings(RenderParams& params, const Scene& scene, const PreparedScene& prepared) {
    params.light_count = static_cast<cl_uint>(prepared.lights.lights.size());
    params.material_count = static_cast<cl_uint>(scene.materials.size());
    params.environment_pmf = prepared.lights.environment_pmf;
    params.environment_left = prepared.lights.environment_left;
    if (scene.environment) {
        params.environment_width = scene.environment->width;
        params.environment_height = scene.environment->height;
        params.environment_r = scene.environment->radiance[0];
        params.environment_g = scene.environment->radiance[1];
        params.environment_b = scene.environment->radiance[2];
    }
    if (prepared.guide) {
        params.guide_x = static_cast<float>(prepared.guide->centre[0]);
        params.guide_y = static_cast<float>(prepared.guide->centre[1]);
        params.guide_z = static_cast<float>(prepared.guide->centre[2]);
        params.guide_radius2 = static_cast<float>(prepared.guide->radius * prepared.guide->radius);
    }
}

}  // namespace

RenderParams params_of(
    const Scene& scene, PreparedScene& prepared, const RenderSettings& settings) {
    RenderParams params{};
    set_camera(params, settings.camera, prepared.placed, settings.width, settings.height);
    params.camera_media = media_at_camera(scene, prepared.media, params);
    if (params.camera_media != 0 && prepared.placed.free_distance > 0) {
        prepared.placed.free_distance = 0;
        set_camera(params, settings.camera, prepared.placed, settings.width, settings.height);
    }
    set_surroundings(params, scene, prepared);
    params.seed = settings.seed;
    params.max_scatterings = settings.termination.kind == TerminationKind::depth
                                 ? settings.termination.depth
                                 : MAX_SCATTERINGS;
    params.roulette = settings.termination.kind == TerminationKind::roulette            ? 1
                      : settings.termination.kind == TerminationKind::roulette_constant ? 2
                                                                                        : 0;
    params.survival = settings.termination.survival;
    params.splits = settings.splits.reflections;
    params.stops = settings.splits.stops;
    params.stop_directions = settings.splits.directions;
    params.split_depth = settings.split_depth;
    return params;
}

}  // namespace wavepath
