#include "wavefront/renderer.h"

#include "device/program.h"
#include "host_memory.h"
#include "prepare/camera_params.h"
#include "prepare/contacts.h"
#include "prepare/hidden_lights.h"
#include "prepare/light_guide.h"
#include "prepare/placement.h"
#include "scene/camera.h"
#include "wavefront/sample_plan.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace wavepath {

namespace {

constexpr std::size_t stream_nodes = 1024;

class Stopwatch {
  public:
    // Seconds since the last lap, or since the start.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void check_lights(
    const Scene& scene,
    const NormalisedScene& geometry,
    const LightTables& tables,
    const MediaTables& media,
    const Method& method,
    RenderResult& result) {
    const bool area =
        std::ranges::any_of(tables.triangle_lights, [](uint32_t row) { return row != NO_LIGHT; });
    const bool punctual = !geometry.lights.empty();
    if (!area && !punctual && !scene.environment && !media.emit)
        throw Error(
            "{}: no light; add an emissive material, a KHR_lights_punctual light, --env or "
            "--env-radiance",
            scene.name);
    if (!punctual) return;
    if (method.sample_lights) {
        const std::string hidden = warning_of_hidden_lights(scene, geometry);
        if (!hidden.empty()) result.warnings.push_back(hidden);
        return;
    }
    if (!area && !scene.environment && !media.emit)
        throw Error(
            "{}: --method {} cannot find punctual lights, and the scene has no other; use direct, "
            "direct-bsdf or mis",
            scene.name, method.name);
    result.warnings.push_back(fmt::format(
        "--method {} cannot find punctual lights: their light is missing", method.name));
}

RenderParams scene_params(
    const Scene& scene,
    const PlacedScene& placed,
    const LightTables& tables,
    const RenderSettings& settings) {
    RenderParams params{};
    set_camera(params, settings.camera, placed, settings.width, settings.height);
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
    params.light_count = static_cast<cl_uint>(tables.lights.size());
    params.material_count = static_cast<cl_uint>(scene.materials.size());
    params.environment_pmf = tables.environment_pmf;
    params.environment_left = tables.environment_left;
    if (scene.environment) {
        params.environment_width = scene.environment->width;
        params.environment_height = scene.environment->height;
        params.environment_r = scene.environment->radiance[0];
        params.environment_g = scene.environment->radiance[1];
        params.environment_b = scene.environment->radiance[2];
    }
    return params;
}

std::vector<bool> triangles_with_holes(const Scene& scene, const NormalisedScene& geometry) {
    std::vector<bool> holes;
    for (const uint32_t material : geometry.materials)
        holes.push_back(scene.materials[material].alpha_mode != AlphaMode::opaque);
    return holes;
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

// Windows are cut to about a second, so that progress, Ctrl-C and limits are met in time; the
// picture does not depend on it.
class Schedule {
  public:
    Schedule(const RenderSettings& settings, uint32_t pool, uint64_t max_cells)
        : pixels_(uint64_t{settings.width} * settings.height),
          plan_(settings.samples, pixels_),
          least_passes_(settings.samples > 0 ? (refills * pool + pixels_ - 1) / pixels_ : 1),
          max_cells_(max_cells),
          seconds_(settings.seconds) {}

    const SamplePlan& plan() const { return plan_; }

    // The next passes, to be rendered window by window.
    std::vector<Window> next(const std::vector<FilmBand>& bands, double elapsed) {
        const double wanted = seconds_ > 0 ? std::clamp(seconds_ - elapsed, 0.0, 1.0) : 1.0;
        const double passes = rate_ > 0 ? wanted * rate_ : 1;
        const uint64_t fit = std::clamp<uint64_t>(max_cells_ / pixels_, 1, SamplePlan::most_rows);
        const std::vector<PlanRow> rows =
            plan_.take(std::min(fit, std::max(least_passes_, static_cast<uint64_t>(passes))));
        passes_ = rows.size();
        std::vector<Window> windows;
        windows.reserve(bands.size());
        for (const FilmBand& band : bands) windows.push_back({band.first_pixel, band.pixels, rows});
        return windows;
    }

    void took(double seconds) {
        if (seconds > 0) rate_ = static_cast<double>(passes_) / seconds;
    }

  private:
    // Units a slot at the least, for the pool runs empty at the end of a window; an open-ended
    // render of a small picture would overshoot with them.
    static constexpr uint64_t refills = 4;

    uint64_t pixels_;
    SamplePlan plan_;
    uint64_t least_passes_;
    uint64_t max_cells_;
    double seconds_;
    double rate_ = 0;  // passes/s
    uint64_t passes_ = 0;
};

}  // namespace

std::string RenderSettings::bias() const {
    std::string cut = termination.bias();
    if (target_error <= 0) return cut;
    return "stopped by --target-error: a stopping rule that reads the samples is slightly biased" +
           (cut.empty() ? "" : "; " + cut);
}

std::string bias_of(const RenderSettings& settings, const RenderResult& result) {
    const std::string bias = settings.bias();
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
    PlacedScene placed = place(scene, settings.camera, settings.width, settings.height);
    const NormalisedScene& geometry = placed.geometry;
    Bvh& bvh = placed.bvh;
    result.times.bvh_build = bvh.build_seconds;
    result.times.normalise = watch.lap() - bvh.build_seconds;
    LightTables tables = build_light_tables(
        scene, geometry, settings.method.light_choice, !settings.method.weigh_both);
    const MediaTables media = build_media_tables(scene, geometry);
    result.warnings = placed.warnings;
    result.warnings.insert(result.warnings.end(), media.warnings.begin(), media.warnings.end());
    check_lights(scene, geometry, tables, media, settings.method, result);
    check_splits(settings, media.scatter);
    const TextureTables textures =
        build_texture_tables(scene, worn_materials(scene, geometry), device.info.max_allocation);
    Features features =
        features_of(scene, geometry, tables, media, textures, settings.method, settings.sobol);
    const bool gains_energy = features.layers_conserve && !settings.layers_conserve;
    features.layers_conserve = features.layers_conserve && settings.layers_conserve;
    const bool branches = settings.splits.reflections > 1 ||
                          (media.scatter && (settings.splits.directions > 1 ||
                                             features.distances != Distances::exponential));
    std::optional<LightGuide> guide;
    if (settings.method.guide && features.weigh_both && !features.transmission)
        guide = guide_to_lights(scene, geometry, tables, media);
    features.guide = guide.has_value();
    result.guided = features.guide;
    features.split_levels = branches ? settings.split_depth : 0;
    result.times.normalise += watch.lap();
    if (features.alpha) mark_holes(bvh, triangles_with_holes(scene, geometry));
    const LampContacts at_lamps = mark_lamp_contacts(scene, geometry, bvh, tables.triangle_lights);
    features.lamp_contacts = at_lamps.surfaces;
    features.lamps_on_lamps = at_lamps.lamps;
    features.contacts = at_lamps.surfaces || ((features.dielectrics || features.transmission) &&
                                              has_contacts(scene, geometry, bvh));
    result.times.bvh_build += watch.lap();
    // On a CPU a tree that outgrows the caches is traversed by many rays in turn, so that they wait
    // for memory together, and a small mesh is traced without its tree, in packets.
    const std::optional<SmallMesh> mesh =
        device.info.is_cpu && !features.alpha ? small_mesh(geometry.positions) : std::nullopt;
    features.ray_packets = mesh.has_value();
    if (features.ray_packets || (device.info.is_cpu && bvh.nodes.size() >= stream_nodes))
        features.rays_per_item = stream_rays;
    const SceneBuffers buffers(device, scene, geometry, bvh, mesh, tables, media, textures);
    result.times.upload = watch.lap();

    RenderParams params = scene_params(scene, placed, tables, settings);
    if (guide) {
        params.guide_x = static_cast<float>(guide->centre[0]);
        params.guide_y = static_cast<float>(guide->centre[1]);
        params.guide_z = static_cast<float>(guide->centre[2]);
        params.guide_radius2 = static_cast<float>(guide->radius * guide->radius);
    }
    params.camera_media = media_at_camera(scene, media, params);
    if (params.camera_media != 0 && placed.free_distance > 0) {
        // what it absorbs begins at the eye
        placed.free_distance = 0;
        set_camera(params, settings.camera, placed, settings.width, settings.height);
    }
    features.far_camera = is_far_camera(params);
    if (!tells_pixels_apart(params))
        result.warnings.push_back(fmt::format(
            "{}: single precision does not tell the pixels of camera \"{}\" apart; bring it closer "
            "or widen its view",
            scene.name, settings.camera.name));
    const std::string source =
        assemble_source(features.defines(), QueueManager::kernel_files(features));
    const cl::Program program = build_program(device, source, &result.program);
    Profile profile;
    // no more slots and cells than there are units of work
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
    // last, so that no buffer takes the place of one it freed: oclgrind mixes them up
    warm_up(device, program, source, features, buffers, settings, params);
    result.times.program_build = watch.lap();

    Schedule schedule(settings, pool, max_cells);
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

    result.film = develop(device, std::move(film), result.samples, result.batches);
    result.outlier = largest_outlier(result.film.image);
    const double samples = static_cast<double>(result.samples) * static_cast<double>(pixels);
    if (auto warning = outlier_warning(result.outlier, samples, gains_energy))
        result.warnings.push_back(*std::move(warning));
    if (result.film.nonfinite.of_media)
        result.warnings.push_back(fmt::format(
            "{}: samples are not finite where more than 4 media lie around one another, "
            "or meet in a plane; take one of them away if any do",
            scene.name));
    else if (result.film.nonfinite.samples > 0 && gains_energy)
        result.warnings.emplace_back(
            "samples are not finite: by --layering specification dielectrics gain energy, without "
            "bound in closed scenes; use --layering conserving");
    else if (result.film.nonfinite.samples > 0)
        result.warnings.push_back(fmt::format(
            "{}: samples are not finite, and why is not known; dim lights whose radiance may "
            "exceed 32 bits, else report the scene",
            scene.name));
    else if (result.batches > 1 && !std::isfinite(result.film.relative_error))
        result.warnings.emplace_back(
            "the variance layer is not finite: squares of the radiance exceed 32 bits; dim the "
            "lights");
    result.profile = profile.rows();
    result.device_clock = profile.device_clock();
    result.rays = queues.ray_counts();
    result.cut_paths = queues.cut_paths();
    result.iterations = queues.iterations();
    result.triangles = geometry.triangle_count();
    result.dropped_triangles = geometry.dropped;
    result.lights = tables.lights.size();
    result.bvh_nodes = bvh.nodes.size();
    result.bvh_blocks = bvh.blocks.size();
    result.scene_bytes = buffers.bytes();
    result.texture_bytes = buffers.textures.bytes();
    result.texture_pages = textures.pages();
    result.pool_bytes = queues.bytes();
    return result;
}

}  // namespace wavepath
