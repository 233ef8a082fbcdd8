#include "wavefront/renderer.h"

#include "device/program.h"
#include "host_memory.h"
#include "prepare/camera_params.h"
#include "shared/path.h"
#include "stopwatch.h"
#include "wavefront/sample_plan.h"
#include "wavefront/schedule.h"
#include "wavefront/upload.h"

#include <algorithm>
#include <cmath>

namespace wavepath {

namespace {

FeatureSettings feature_settings_of(
    const RenderSettings& settings, const RenderParams& params, const DeviceInfo& device) {
    return {
        .method = settings.method,
        .splits = settings.splits,
        .split_depth = settings.split_depth,
        .sobol = settings.sobol,
        .layers_conserve = settings.layers_conserve,
        .far_camera = is_far_camera(params),
        .is_cpu = device.is_cpu,
        .kernels = settings.kernels};
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

// What the samples themselves show to be wrong. `gains_energy`: some layer may.
void warn_of_samples(
    RenderResult& result, const std::string& scene, uint64_t pixels, bool gains_energy) {
    const double samples = static_cast<double>(result.samples) * static_cast<double>(pixels);
    if (auto warning = outlier_warning(result.outlier, samples, gains_energy))
        result.warnings.push_back(*std::move(warning));
    if (result.film.nonfinite.of_media)
        result.warnings.push_back(fmt::format(
            "{}: samples are not finite where more than 4 media lie around one another, "
            "or meet in a plane; take one of them away if any do",
            scene));
    else if (result.film.nonfinite.samples > 0 && gains_energy)
        result.warnings.emplace_back(
            "samples are not finite: by --layering specification dielectrics gain energy, without "
            "bound in closed scenes; use --layering conserving");
    else if (result.film.nonfinite.samples > 0)
        result.warnings.push_back(fmt::format(
            "{}: samples are not finite, and why is not known; dim lights whose radiance may "
            "exceed 32 bits, else report the scene",
            scene));
    else if (result.batches > 1 && !std::isfinite(result.film.relative_error))
        result.warnings.emplace_back(
            "the variance layer is not finite: squares of the radiance exceed 32 bits; dim the "
            "lights");
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
    const UploadedScene& uploaded,
    const RenderSettings& settings,
    const std::function<void(const RenderProgress&)>& progress,
    const std::function<bool()>& stop) {
    const PreparedScene& prepared = uploaded.prepared;
    RenderResult result;
    result.times = uploaded.times;
    result.warnings = uploaded.warnings;
    Stopwatch watch;
    const Features features = features_of(
        uploaded.scene, prepared, feature_settings_of(settings, uploaded.params, device.info));
    const std::string source = QueueManager::source_of(features);
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
        device, program, source, features, uploaded.buffers, pool, max_cells, settings.work_groups,
        settings.count_lag.value_or(device.info.is_cpu ? 0 : 1), profile);
    check_memory(device, uploaded.buffers.bytes() + queues.bytes(), settings);
    Film film(device, settings.width, settings.height, max_cells);
    result.film_bytes = film.bytes();
    // Last, so that no buffer takes the place of one it freed: oclgrind mixes them up.
    warm_up(device, program, source, features, uploaded.buffers, settings, uploaded.params);
    result.times.program_build = watch.lap();

    Schedule schedule(pixels, settings.samples, settings.seconds, pool, max_cells);
    take_samples(device, settings, uploaded.params, schedule, queues, film, progress, stop, result);
    result.film = develop(device, std::move(film), result.samples, result.batches);
    result.outlier = largest_outlier(result.film.image);
    warn_of_samples(
        result, uploaded.scene.name, pixels, features.has_layers && !features.layers_conserve);
    result.profile = profile.rows();
    result.device_clock = profile.device_clock();
    result.rays = queues.ray_counts();
    result.cut_paths = queues.cut_paths();
    result.iterations = queues.iterations();
    result.pool_bytes = queues.bytes();
    result.guided = features.guide;
    describe(result, prepared, uploaded.buffers);
    return result;
}

RenderResult render(
    const Device& device,
    const Scene& scene,
    const RenderSettings& settings,
    const std::function<void(const RenderProgress&)>& progress,
    const std::function<bool()>& stop) {
    return render(device, upload(device, scene, settings), settings, progress, stop);
}

}  // namespace wavepath
