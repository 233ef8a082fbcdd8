#include "wavefront/queue_manager.h"

#include <algorithm>
#include <numeric>

namespace wavepath {

namespace {

template <typename StageType>
std::optional<StageType> stage_if(
    bool needed, const cl::Program& program, const std::string& name, uint32_t local_size, Profile& profile) {
    if (!needed) return std::nullopt;
    return std::optional<StageType>(std::in_place, program, name, local_size, profile);
}

}  // namespace

std::vector<std::string> QueueManager::kernel_files(const Features& features) {
    std::vector<std::string> names{"assign_units", "generate_rays", "intersect", "first_hit"};
    if (features.environment) names.emplace_back("shade_miss");
    if (features.area_lights) names.emplace_back("shade_emission");
    if (features.sample_lights) names.insert(names.end(), {"direct_light", "occlusion"});
    names.insert(names.end(), {"sample_indirect", "roulette_compact", "scan_queue", "scatter_queue", "accumulate", "fold_film"});
    for (std::string& name : names) name = "stages/" + name + ".cl";
    return names;
}

QueueManager::QueueManager(
    const Device& device, const cl::Program& program, const Features& features, const SceneBuffers& scene, uint32_t slots,
    uint64_t max_cells, WorkGroups groups, Profile& profile)
    : device_(device),
      features_(features),
      scene_(scene),
      profile_(profile),
      pool_(device, slots, features),
      params_(device, 1, "parameters"),
      plan_(device, max_cells, "sample plan"),
      cells_(device, std::size_t{SUM_PLANES} * max_cells, "units of work"),
      cell_flags_(device, max_cells, "units of work"),
      assign_units_(program, "assign_units", groups.streaming, profile),
      generate_rays_(program, "generate_rays", groups.streaming, profile),
      intersect_(program, "intersect", groups.traversal, profile),
      first_hit_(program, "first_hit", groups.streaming, profile),
      shade_miss_(stage_if<decltype(shade_miss_)::value_type>(features.environment, program, "shade_miss", groups.streaming, profile)),
      shade_emission_(
          stage_if<decltype(shade_emission_)::value_type>(features.area_lights, program, "shade_emission", groups.streaming, profile)),
      direct_light_(
          stage_if<decltype(direct_light_)::value_type>(features.sample_lights, program, "direct_light", groups.streaming, profile)),
      occlusion_(stage_if<decltype(occlusion_)::value_type>(features.sample_lights, program, "occlusion", groups.traversal, profile)),
      sample_indirect_(program, "sample_indirect", groups.streaming, profile),
      roulette_compact_(program, "roulette_compact", groups.streaming, profile),
      scan_queue_(program, "scan_queue", groups.traversal, profile),
      scatter_queue_(program, "scatter_queue", groups.traversal, profile),
      accumulate_(program, "accumulate", groups.streaming, profile),
      fold_film_(program, "fold_film", groups.streaming, profile) {}

void QueueManager::render(const Window& window, RenderParams params, Film& film) {
    params.stride = pool_.stride;
    params.first_pixel = window.first_pixel;
    params.window_pixels = window.pixels;
    params.cells = static_cast<cl_uint>(window.pixels * window.rows.size());
    params.pool = std::min(pool_.slots, params.cells);
    params.pixel_step = params.pool % window.pixels;
    params.pass_step = params.pool / window.pixels;
    device_.queue.enqueueWriteBuffer(params_.buffer(), CL_TRUE, 0, sizeof(params), &params);
    device_.queue.enqueueWriteBuffer(plan_.buffer(), CL_TRUE, 0, window.rows.size() * sizeof(PlanRow), window.rows.data());

    assign_units_.launch(device_, params.pool, params_, pool_.active[0], pool_.ended, pool_.sizes[0], pool_.ids, pool_.radiances);
    QueueSizes sizes{};
    sizes.active = sizes.ended = params.pool;
    std::size_t now = 0;  // which of the two queues is this iteration's
    while (sizes.active > 0) {
        const std::size_t next = 1 - now;
        const Sizes& lengths = pool_.sizes[now];
        const Uints& queue = pool_.active[now];

        generate_rays_.launch(device_, sizes.ended, params_, lengths, pool_.ended, plan_, pool_.ids, pool_.rays, pool_.throughputs, pool_.radiances);
        intersect_.launch(device_, sizes.active, params_, lengths, queue, scene_.nodes, scene_.blocks, pool_.rays, pool_.hits);
        first_hit_.launch(device_, sizes.ended, params_, lengths, pool_.ended, scene_.triangles, scene_.materials, pool_.rays, pool_.hits, pool_.radiances);
        if (shade_miss_)
            shade_miss_->launch(device_, sizes.active, params_, lengths, queue, scene_.environment, pool_.rays, pool_.hits, pool_.throughputs, pool_.radiances);
        if (shade_emission_)
            shade_emission_->launch(device_, sizes.active, params_, lengths, queue, scene_.triangles, scene_.materials, scene_.lights, pool_.rays, pool_.hits, pool_.throughputs, pool_.radiances);
        if (direct_light_) {
            direct_light_->launch(device_, sizes.active, params_, lengths, queue, scene_.triangles, scene_.materials, scene_.lights, scene_.environment, pool_.rays, pool_.hits, pool_.throughputs, pool_.ids, pool_.shadows);
            occlusion_->launch(device_, sizes.active, params_, lengths, queue, scene_.nodes, scene_.blocks, pool_.shadows, pool_.radiances, pool_.fates);
        }
        sample_indirect_.launch(device_, sizes.active, params_, lengths, queue, scene_.triangles, scene_.materials, pool_.rays, pool_.hits, pool_.throughputs, pool_.ids);
        roulette_compact_.launch(device_, sizes.active, params_, lengths, queue, plan_, pool_.ids, pool_.hits, pool_.throughputs, pool_.fates);
        const uint64_t chunks = (sizes.active + QUEUE_CHUNK - 1) / QUEUE_CHUNK;
        scan_queue_.launch(device_, chunks, lengths, pool_.fates, pool_.chunk_counts);
        scatter_queue_.launch(device_, chunks, params_, lengths, queue, pool_.fates, pool_.chunk_counts, pool_.ids, pool_.active[next], pool_.ended, pool_.sizes[next], pool_.statistics);

        closest_rays_ += sizes.active;
        sizes = read_sizes(pool_.sizes[next]);
        if (sizes.runaway_lock != 0) report_runaway(sizes, window);
        accumulate_.launch(device_, sizes.ended, params_, pool_.sizes[next], pool_.ended, plan_, pool_.radiances, pool_.ids, cells_, cell_flags_);
        now = next;
        ++iterations_;
    }
    fold_film_.launch(device_, window.pixels, params_, plan_, cells_, cell_flags_, film.planes, film.flags);
    device_.queue.finish();
    profile_.collect();
}

QueueSizes QueueManager::read_sizes(const Sizes& sizes) {
    QueueSizes host{};
    device_.queue.enqueueReadBuffer(sizes.buffer(), CL_TRUE, 0, sizeof(host), &host);
    profile_.collect();
    return host;
}

void QueueManager::report_runaway(const QueueSizes& sizes, const Window& window) const {
    const PlanRow& row = window.rows[sizes.runaway_pass];
    throw Error(
        "pixel {}, sample {}: the path is still alive after {} scatterings: nothing in the scene absorbs it; "
        "lower an albedo, or use --termination depth:D (biased)",
        sizes.runaway_pixel, row.samples_before + row.first_sample + sizes.runaway_sample, MAX_SCATTERINGS);
}

RayCounts QueueManager::ray_counts() const {
    const std::vector<cl_uint> rows = pool_.statistics.read(device_);
    RayCounts counts;
    counts.path_lengths.assign(DEPTH_BINS, 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t column = i % STATISTICS;
        (column < DEPTH_BINS ? counts.path_lengths[column] : counts.connections) += rows[i];
    }
    counts.closest = closest_rays_;
    return counts;
}

std::size_t QueueManager::bytes() const {
    return pool_.bytes() + params_.bytes() + plan_.bytes() + cells_.bytes() + cell_flags_.bytes();
}

}  // namespace wavepath
