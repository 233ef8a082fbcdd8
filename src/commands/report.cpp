#include "commands/report.h"

#include "commands/json_text.h"
#include "commands/revision.h"

#include <sys/resource.h>

#include <algorithm>
#include <numbers>

namespace wavepath {

using nlohmann::ordered_json;

namespace {

uint64_t peak_host_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

ordered_json image_reports(const Scene& scene) {
    ordered_json images = ordered_json::array();
    for (const TextureImage& image : scene.images)
        images.push_back(
            {{"width", image.width}, {"height", image.height}, {"bits", image.wide ? 16 : 8}});
    return images;
}

ordered_json scene_report(const RenderJob& job, const RenderResult& result) {
    return {
        {"name", job.scene.name},
        {"triangles", result.triangles},
        {"zero_area_triangles", result.dropped_triangles},
        {"materials", job.scene.materials.size()},
        {"images", image_reports(job.scene)},
        {"texture_pages", result.texture_pages},
        {"lights", result.lights},
        {"bvh_nodes", result.bvh_nodes},
        {"bvh_blocks", result.bvh_blocks},
    };
}

ordered_json times_report(const RenderJob& job, const RenderResult& result) {
    return {
        {"load", job.load_seconds},
        {"normalise", result.times.normalise},
        {"bvh_build", result.times.bvh_build},
        {"upload", result.times.upload},
        {"program_build", result.times.program_build},
        {"render", result.times.render},
    };
}

ordered_json build_report(const BuildReport& build) {
    ordered_json kernels = ordered_json::array();
    for (const KernelBuild& kernel : build.kernels)
        kernels.push_back(
            {{"kernel", kernel.name},
             {"private_bytes", kernel.private_bytes},
             {"local_bytes", kernel.local_bytes},
             {"preferred_multiple", kernel.preferred_multiple}});
    return {
        {"seconds", build.seconds},
        {"from_own_cache", build.from_cache},
        {"binary_bytes",
         build.binary_bytes ? ordered_json(*build.binary_bytes) : ordered_json(nullptr)},
        {"kernels", kernels},
    };
}

ordered_json rays_report(const RenderResult& result) {
    const auto rays = static_cast<double>(result.rays.closest + result.rays.connections);
    return {
        {"closest_hit", result.rays.closest},
        {"occlusion", result.rays.connections},
        {"per_s", json_number(rays / result.times.render)},
    };
}

ordered_json memory_report(const RenderResult& result) {
    return {
        {"host_peak", peak_host_memory()},         {"device_scene", result.scene_bytes},
        {"device_textures", result.texture_bytes}, {"device_pool", result.pool_bytes},
        {"device_film", result.film_bytes},
    };
}

}  // namespace

std::string build_text() {
    return fmt::format("{} ({}), {}", WAVEPATH_VERSION, revision, WAVEPATH_COMPILER);
}

ordered_json settings_report(const RenderJob& job) {
    const RenderSettings& settings = job.settings;
    ordered_json environment = nullptr;
    if (job.scene.environment)
        environment = {
            {"map", job.scene.environment->name}, {"radiance", job.scene.environment->radiance}};
    ordered_json report = {
        {"width", settings.width},
        {"height", settings.height},
        {"scene_of_file", job.scene_of_file},
        {"camera", settings.camera.name},
        {"camera_to_world", settings.camera.to_world},
        {"y_fov_deg", settings.camera.orthographic
                          ? ordered_json(nullptr)
                          : ordered_json(settings.camera.y_fov * 180 / std::numbers::pi)},
        {"orthographic_m", settings.camera.orthographic
                               ? ordered_json{settings.camera.x_mag, settings.camera.y_mag}
                               : ordered_json(nullptr)},
        {"environment", environment},
        {"lumens_per_watt", job.lumens_per_watt},
        {"samples", settings.samples},
        {"time_limit_s", settings.seconds},
        {"target_error", settings.target_error},
        {"seed", settings.seed},
        {"method", settings.method.name},
        {"light_choice", settings.method.light_choice == LightChoice::area ? "area" : "power"},
        {"guide", settings.method.guide},
        {"termination", settings.termination.text()},
        {"sampler", settings.sobol ? "sobol" : "independent"},
        {"layering", settings.layers_conserve ? "conserving" : "specification"},
        {"splits",
         {settings.splits.stops, settings.splits.directions, settings.splits.reflections}},
        {"split_depth", settings.split_depth},
        {"pool", settings.pool},
    };
    const auto encloses = [](const Material& m) { return m.boundary != Boundary::opaque; };
    if (std::ranges::any_of(job.scene.materials, encloses)) {
        report["distance"] = name_of(settings.method.distances);
        report["direction"] = settings.method.phase_directions ? "phase" : "uniform";
    }
    return report;
}

ordered_json profile_report(const RenderResult& result) {
    double kernels = 0;
    ordered_json rows = ordered_json::array();
    for (const ProfileRow& row : result.profile) {
        kernels += row.seconds;
        const auto items = static_cast<double>(row.items);
        rows.push_back({
            {"kernel", row.name},
            {"launches", row.launches},
            {"items", row.items},
            {"seconds", row.seconds},
            {"share", json_number(row.seconds / result.times.render)},
            {"ns_per_item", json_number(1e9 * row.seconds / items)},
            {"items_per_s", json_number(items / row.seconds)},
        });
    }
    return {
        {"device_clock", result.device_clock},
        {"tracing", result.tracing},
        {"kernels", rows},
        {"kernel_seconds", kernels},
        {"outside_kernels_seconds", result.times.render - kernels},
        {"iterations", result.iterations},
    };
}

ordered_json render_report(const Device& device, const RenderJob& job, const RenderResult& result) {
    const double pixels = double{1} * job.settings.width * job.settings.height;
    const double samples = pixels * static_cast<double>(result.samples);
    uint64_t paths = 0;
    for (const uint64_t n : result.rays.path_lengths) paths += n;
    ordered_json report = {
        {"schema", report_schema},
        {"program", "wavepath"},
        {"version", WAVEPATH_VERSION},
        {"build", build_text()},
        {"settings", settings_report(job)},
        {"device",
         {{"platform", device.info.platform},
          {"name", device.info.name},
          {"version", device.info.version},
          {"driver", device.info.driver},
          {"compute_units", device.info.compute_units}}},
        {"scene", scene_report(job, result)},
        {"times_s", times_report(job, result)},
        {"program_build", build_report(result.program)},
        {"samples_per_pixel", result.samples},
        {"samples_per_s", json_number(samples / result.times.render)},
        {"batches", result.batches},
        {"rays", rays_report(result)},
        {"path_lengths", result.rays.path_lengths},
        {"mean_path_length",
         json_number(static_cast<double>(result.rays.closest) / static_cast<double>(paths))},
        {"relative_error", json_number(result.film.relative_error)},
        {"largest_outlier",
         {{"share", json_number(result.outlier.share)},
          {"x", result.outlier.x},
          {"y", result.outlier.y}}},
        {"bias", bias_of(job.settings, result)},
        {"nonfinite_samples", result.film.nonfinite.samples},
        {"cut_paths", result.cut_paths.count},
        {"guided", result.guided},
        {"interrupted", result.interrupted},
        {"memory_bytes", memory_report(result)},
        {"warnings", result.warnings},
    };
    if (result.film.nonfinite.samples > 0)
        report["first_nonfinite"] = {
            {"x", result.film.nonfinite.x},
            {"y", result.film.nonfinite.y},
            {"sample", result.film.nonfinite.sample}};
    if (result.cut_paths.count > 0)
        report["first_cut"] = {
            {"x", result.cut_paths.x},
            {"y", result.cut_paths.y},
            {"sample", result.cut_paths.sample}};
    report["profile"] = profile_report(result);
    return report;
}

}  // namespace wavepath
