#include "wavefront/renderer.h"

#include "device/program.h"
#include "host_memory.h"
#include "prepare/camera_params.h"
#include "prepare/hidden_lights.h"
#include "prepare/prepared_scene.h"
#include "shared/path.h"
#include "stopwatch.h"
#include "wavefront/render_params.h"
#include "wavefront/sample_plan.h"
#include "wavefront/sample_warnings.h"
#include "wavefront/schedule.h"

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
        .page_bytes = device.max_allocation};
}

FeatureSettings feature_settings_of(
    const RenderSettings& settings, bool far_camera, const DeviceInfo& device) {
    return {
        .method = settings.method,
        .splits = settings.splits,
        .split_depth = settings.split_depth,
        .sobol = settings.sobol,
        .layers_conserve = settings.layers_conserve,
        .far_camera = far_camera,
        .is_cpu = device.is_cpu};
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

// Before the film is made, for a CPU's memory is everybody's.
void check_memory(const Device& device, uint64_t others, const RenderSettings& settings) {
    constexpr auto mebibytes = [](uint64_t bytes) { return (bytes + (1U << 20U) - 1) >> 20U; };
    const uint64_t film = uint64_t{Film::pixel_bytes} * settings.width * settings.height;
    uint64_t there = device.info.global_memory;
    if (device.info.is_cpu) there = std::min<uint64_t>(there, others + available_memory());
    if (others + film > there)
        throw Error(
            "{} MiB of device memory needed, of which {} for the film, {} bytes a pixel; there are "
            "{} MiB; use a smaller --size or --pool, or another --device",
            mebibytes(others + film), mebibytes(film), Film::pixel_bytes, there >> 20U);
}

// PoCL compiles a kernel at its first launch: one short path through the whole chain, into a film
// of its own, before the clock starts.
void warm_up(
    const Device& device,
    const cl::Program& program,
    const std::string& source,
    const Features& features,
    const SceneBuffers& buffers,
    const RenderSettings& settings,
    RenderParams params) {
    params.width = 1;
    params.height = 1;
    params.max_scatterings = 1;
    Profile profile;
    QueueManager queues(
        device, program, source, features, buffers, QUEUE_CHUNK, 1, settings.work_groups, 0,
        profile);
    Film film(device, 1, 1, 1);
    const Window window{0, 1, {PlanRow{0, 1, 0, 1}}};
    queues.render(window, params, film);
    queues.load_compaction();
}

// Renders window by window until the samples, the time or the error asked for are there.
void take_samples(
    const Device& device,
    const RenderSettings& settings,
    const RenderParams& params,
    Schedule& schedule,
    QueueManager& queues,
    Film& film,
    const std::function<void(const RenderProgress&)>& progress,
    const std::function<bool()>& stop,
    RenderResult& result) {
    Stopwatch watch;
    const SamplePlan& plan = schedule.plan();
    const auto error_so_far = [&] {
        return relative_error(device, film, result.samples, result.batches);
    };
    while (!plan.done()) {
        const std::vector<Window> windows = schedule.next(film.bands, result.times.render);
        // Once one window is in the film, the passes have to be finished everywhere.
        const bool whole = queues.render(windows.front(), params, film, stop);
        for (std::size_t i = 1; whole && i < windows.size(); ++i)
            queues.render(windows[i], params, film);
        const double seconds = watch.lap();
        schedule.took(seconds);
        result.times.render += seconds;
        if (whole) {
            result.samples = plan.samples_taken();
            result.batches = plan.batches_closed();
        }
        result.interrupted = !whole || (!plan.done() && stop());
        if (progress && whole) {
            const RayCounts rays = queues.ray_counts();
            progress(
                {result.samples, settings.samples, result.times.render,
                 rays.closest + rays.connections, error_so_far});
        }
        const bool timed_out = settings.seconds > 0 && result.times.render >= settings.seconds;
        const bool on_target = settings.target_error > 0 && error_so_far() < settings.target_error;
        if (result.interrupted || timed_out || on_target) break;
    }
}

void describe(RenderResult& result, const PreparedScene& prepared, const SceneBuffers& buffers) {
    result.triangles = prepared.geometry().triangle_count();
    result.dropped_triangles = prepared.geometry().dropped;
    result.lights = prepared.lights.lights.size();
    result.bvh_nodes = prepared.placed.bvh.nodes.size();
    result.bvh_blocks = prepared.placed.bvh.blocks.size();
    result.scene_bytes = buffers.bytes();
    result.texture_bytes = buffers.textures.bytes();
    result.texture_pages = prepared.textures.pages();
}

DevelopedFilm develop_timed(
    const Device& device, Profile& profile, Film&& film, const RenderResult& result) {
    const HostSpan span(profile.timeline(), "develop");
    return develop(device, std::move(film), result.samples, result.batches);
}

void describe_work(
    RenderResult& result, const Features& features, Profile& profile, const QueueManager& queues) {
    result.tracing = features.tracing();
    result.guided = features.guide;
    result.profile = profile.rows();
    result.device_clock = profile.device_clock();
    result.timeline = profile.take_timeline();
    result.rays = queues.ray_counts();
    result.cut_paths = queues.cut_paths();
    result.iterations = queues.iterations();
    result.pool_bytes = queues.bytes();
}

}  // namespace

std::string RenderSettings::bias() const {
    std::string cut = termination.bias();
    if (target_error <= 0) return cut;
    return "stopped by --target-error: a stopping rule that reads the samples is slightly biased" +
           (cut.empty() ? "" : "; " + cut);
}

std::string bias_of(const RenderSettings& settings, const RenderResult& result) {
    std::string bias = settings.bias();
    if (result.cut_paths.count == 0) return bias;
    return fmt::format(
               "biased: {} cut after {} scatterings, whose further light is missing",
               result.cut_paths.count == 1 ? "1 path was"
                                           : fmt::format("{} paths were", result.cut_paths.count),
               MAX_SCATTERINGS) +
           (bias.empty() ? "" : "; " + bias);
}

RenderResult render(
    const Device& device,
    const Scene& scene,
    const RenderSettings& settings,
    const std::function<void(const RenderProgress&)>& progress,
    const std::function<bool()>& stop) {
    RenderResult result;
    Stopwatch watch;
    PreparedScene prepared = prepare(scene, settings.camera, preparation_of(settings, device.info));
    result.times.normalise = prepared.normalise_seconds;
    result.times.bvh_build = prepared.bvh_seconds;
    result.warnings = prepared.placed.warnings;
    check_lights(scene, prepared, settings.method, result.warnings);
    check_splits(settings, prepared.media.scatter);
    const RenderParams params = params_of(scene, prepared, settings);
    if (!tells_pixels_apart(params))
        result.warnings.push_back(fmt::format(
            "{}: single precision does not tell the pixels of camera \"{}\" apart; bring it closer "
            "or widen its view",
            scene.name, settings.camera.name));
    const Features features = features_of(
        scene, prepared, feature_settings_of(settings, is_far_camera(params), device.info));
    watch.lap();
    const SceneBuffers buffers(device, scene, prepared);
    result.times.upload = watch.lap();

    const std::string source =
        assemble_source(features.defines(), QueueManager::kernel_files(features));
    const cl::Program program = build_program(device, source, &result.program);
    Profile profile;
    // No more slots and cells than there are units of work.
    const uint64_t pixels = uint64_t{settings.width} * settings.height;
    const uint64_t units = SamplePlan(settings.samples, pixels).most_passes() * pixels;
    const uint32_t wanted = settings.pool > 0 ? settings.pool : device.info.default_pool;
    const auto pool = static_cast<uint32_t>(std::min<uint64_t>(wanted, units));
    const uint64_t max_cells = std::min(
        {std::max(uint64_t{1} << 20U, uint64_t{4} * pool), units,
         device.info.max_allocation / (CELL_FLOATS * sizeof(cl_float))});
    QueueManager queues(
        device, program, source, features, buffers, pool, max_cells, settings.work_groups,
        settings.count_lag.value_or(device.info.is_cpu ? 0 : 1), profile);
    check_memory(device, buffers.bytes() + queues.bytes(), settings);
    Film film(device, settings.width, settings.height, max_cells);
    result.film_bytes = film.bytes();
    // Last, so that no buffer takes the place of one it freed: oclgrind mixes them up.
    warm_up(device, program, source, features, buffers, settings, params);
    describe_build(device, program, result.program);
    result.times.program_build = watch.lap();

    if (settings.keeps_timeline) profile.keep_timeline(device);
    Schedule schedule(pixels, settings.samples, settings.seconds, pool, max_cells);
    take_samples(device, settings, params, schedule, queues, film, progress, stop, result);
    result.film = develop_timed(device, profile, std::move(film), result);
    result.outlier = largest_outlier(result.film.image);
    warn_of_samples(result, scene.name, pixels, features.has_layers && !features.layers_conserve);
    describe_work(result, features, profile, queues);
    describe(result, prepared, buffers);
    return result;
}

}  // namespace wavepath
