#include "wavefront/upload.h"

#include "prepare/camera_params.h"
#include "prepare/hidden_lights.h"
#include "stopwatch.h"
#include "wavefront/render_params.h"

#include <algorithm>
#include <cmath>

namespace wavepath {

namespace {

// Throws Error where nothing shines, or nothing that the method can find.
void check_lights(
    const Scene& scene,
    const PreparedScene& prepared,
    const Method& method,
    std::vector<std::string>& warnings) {
    const NormalisedScene& geometry = prepared.geometry();
    const bool area = prepared.has_area_lights();
    const bool emits = prepared.media.emit;
    const bool punctual = !geometry.lights.empty();
    if (!area && !punctual && !scene.environment && !emits)
        throw Error(
            "{}: no light; add an emissive material, a KHR_lights_punctual light, --env or "
            "--env-radiance",
            scene.name);
    if (!punctual) return;
    if (method.sample_lights) {
        const std::string hidden = warning_of_hidden_lights(scene, geometry);
        if (!hidden.empty()) warnings.push_back(hidden);
        return;
    }
    if (!area && !scene.environment && !emits)
        throw Error(
            "{}: --method {} cannot find punctual lights, and the scene has no other; use direct, "
            "direct-bsdf or mis",
            scene.name, method.name);
    warnings.push_back(fmt::format(
        "--method {} cannot find punctual lights: their light is missing", method.name));
}

Preparation preparation_of(const RenderSettings& settings, const DeviceInfo& device) {
    return {
        .width = settings.width,
        .height = settings.height,
        .light_choice = settings.method.light_choice,
        .lights_alone = !settings.method.weigh_both,
        .aims = settings.method.guide && settings.method.weigh_both,
        .page_bytes = device.max_allocation,
        .texture_rows = settings.kernels == Kernels::full_features};
}

void check_splits(const RenderSettings& settings, bool media_scatter) {
    const Splits& splits = settings.splits;
    if (media_scatter && splits.stops > 1 && settings.method.distances == Distances::exponential)
        throw Error(
            "--splits with more than one stop: --distance exponential has one or none; choose "
            "another");
    if (settings.split_depth == 0 &&
        std::max({splits.stops, splits.directions, splits.reflections}) > 1)
        throw Error("--splits with --split-depth 0: nothing would branch; take 1 or more");
    constexpr double most = 1e8;
    const double children =
        splits.reflections + (media_scatter ? double{1} * splits.stops * splits.directions : 0);
    const double paths = std::pow(children, settings.split_depth);
    if (children > 1 && paths > most)
        throw Error(
            "--splits {},{},{} --split-depth {}: up to {:.0g} paths a sample, "
            "at most {:.0g}; lower them",
            splits.stops, splits.directions, splits.reflections, settings.split_depth, paths, most);
}

}  // namespace

UploadedScene upload(const Device& device, const Scene& scene, const RenderSettings& settings) {
    UploadedScene uploaded{
        .scene = scene,
        .prepared = prepare(scene, settings.camera, preparation_of(settings, device.info))};
    const PreparedScene& prepared = uploaded.prepared;
    uploaded.times.normalise = prepared.normalise_seconds;
    uploaded.times.bvh_build = prepared.bvh_seconds;
    uploaded.warnings = prepared.placed.warnings;
    check_lights(scene, prepared, settings.method, uploaded.warnings);
    check_splits(settings, prepared.media.scatter);
    uploaded.params = params_of(scene, uploaded.prepared, settings);
    if (!tells_pixels_apart(uploaded.params))
        uploaded.warnings.push_back(fmt::format(
            "{}: single precision does not tell the pixels of camera \"{}\" apart; bring it closer "
            "or widen its view",
            scene.name, settings.camera.name));
    Stopwatch watch;
    uploaded.buffers = SceneBuffers(device, scene, prepared);
    uploaded.times.upload = watch.lap();
    return uploaded;
}

}  // namespace wavepath
