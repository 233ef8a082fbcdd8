#include "wavefront/queue_manager.h"

#include "wavefront/sample_plan.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace wavepath {

namespace {

// Iterations for a window to end by itself after a request to stop.
constexpr uint64_t grace = 1000;

template <typename StageType>
std::optional<StageType> stage_if(
    bool needed,
    const cl::Program& program,
    const std::string& name,
    uint32_t local_size,
    Profile& profile,
    uint32_t slots_per_item = 1) {
    if (!needed) return std::nullopt;
    return std::optional<StageType>(
        std::in_place, program, name, local_size, profile, slots_per_item);
}

}  // namespace

void CutPaths::add(const CutPaths& more) {
    if (more.count == 0) return;
    if (count == 0 || std::tie(more.y, more.x, more.sample) < std::tie(y, x, sample))
        std::tie(x, y, sample) = std::tie(more.x, more.y, more.sample);
    count += more.count;
}

std::vector<std::string> QueueManager::kernel_files(const Features& features) {
    std::vector<std::string> names{"assign_units", "generate_rays", "intersect", "scatter_queue",
                                   "move_paths",   "interact",      "first_hit"};
    if (features.textures) names.emplace_back("apply_textures");
    if (features.environment) names.emplace_back("shade_miss");
    if (features.area_lights) names.emplace_back("shade_emission");
    if (features.sample_lights)
        names.insert(
            names.end(), {"direct_light",
                          features.connections_by_hits() ? "connect_through_media" : "occlusion"});
    if (features.media) names.insert(names.end(), {"sample_distance", "pass_boundary"});
    if (features.smooth_walls) names.emplace_back("pass_walls");
    if (features.partial_boundaries) names.emplace_back("decide_boundary");
    if (features.contacts) names.emplace_back("find_contacts");
    if (features.dielectrics) names.emplace_back("refract_boundary");
    if (features.media_scatter) names.emplace_back("scatter_medium");
    names.insert(
        names.end(),
        {"sample_indirect", "roulette_compact", "scan_queue", "accumulate", "fold_film"});
    if (features.split_levels > 0) names.emplace_back("resume_branch");
    for (std::string& name : names) name.insert(0, "stages/").append(".cl");
    return names;
}

QueueManager::QueueManager(
    const Device& device,
    const cl::Program& program,
    const Features& features,
    const SceneBuffers& scene,
    uint32_t slots,
    uint64_t max_cells,
    WorkGroups groups,
    uint32_t count_lag,
    Profile& profile)
    : device_(device),
      features_(features),
      scene_(scene),
      profile_(profile),
      pool_(device, slots, features),
      params_(device, 1, "parameters"),
      plan_(device, std::min<uint64_t>(max_cells, SamplePlan::most_rows), "sample plan"),
      cells_(device, std::size_t{CELL_FLOATS} * max_cells, "units of work"),
      cell_flags_(device, max_cells, "units of work"),
      count_lag_(count_lag),
      assign_units_(program, "assign_units", groups.streaming, profile),
      generate_rays_(program, "generate_rays", groups.streaming, profile),
      intersect_(
          program,
          "intersect",
          features.rays_per_item > 1 ? 1 : groups.traversal,
          profile,
          features.rays_per_item),
      find_contacts_(stage_if<decltype(find_contacts_)::value_type>(
          features.contacts, program, "find_contacts", groups.traversal, profile)),
      sample_distance_(stage_if<decltype(sample_distance_)::value_type>(
          features.media, program, "sample_distance", groups.streaming, profile)),
      interact_(program, "interact", groups.streaming, profile),
      apply_textures_(stage_if<decltype(apply_textures_)::value_type>(
          features.textures, program, "apply_textures", groups.streaming, profile)),
      decide_boundary_(stage_if<decltype(decide_boundary_)::value_type>(
          features.partial_boundaries, program, "decide_boundary", groups.streaming, profile)),
      pass_boundary_(stage_if<decltype(pass_boundary_)::value_type>(
          features.media, program, "pass_boundary", groups.streaming, profile)),
      shade_miss_(stage_if<decltype(shade_miss_)::value_type>(
          features.environment, program, "shade_miss", groups.streaming, profile)),
      shade_emission_(stage_if<decltype(shade_emission_)::value_type>(
          features.area_lights, program, "shade_emission", groups.streaming, profile)),
      direct_light_(stage_if<decltype(direct_light_)::value_type>(
          features.sample_lights, program, "direct_light", groups.streaming, profile)),
      occlusion_(stage_if<decltype(occlusion_)::value_type>(
          features.sample_lights && !features.connections_by_hits(),
          program,
          "occlusion",
          features.rays_per_item > 1 ? 1 : groups.traversal,
          profile,
          features.rays_per_item)),
      connect_through_media_(stage_if<decltype(connect_through_media_)::value_type>(
          features.sample_lights && features.connections_by_hits(),
          program,
          "connect_through_media",
          groups.traversal,
          profile)),
      pass_walls_(stage_if<decltype(pass_walls_)::value_type>(
          features.smooth_walls, program, "pass_walls", groups.streaming, profile)),
      first_hit_(program, "first_hit", groups.streaming, profile),
      refract_boundary_(stage_if<decltype(refract_boundary_)::value_type>(
          features.dielectrics, program, "refract_boundary", groups.streaming, profile)),
      sample_indirect_(program, "sample_indirect", groups.streaming, profile),
      scatter_medium_(stage_if<decltype(scatter_medium_)::value_type>(
          features.media_scatter, program, "scatter_medium", groups.streaming, profile)),
      roulette_compact_(program, "roulette_compact", groups.streaming, profile),
      resume_branch_(stage_if<decltype(resume_branch_)::value_type>(
          features.split_levels > 0, program, "resume_branch", groups.streaming, profile)),
      scan_queue_(program, "scan_queue", groups.traversal, profile, QUEUE_CHUNK),
      scatter_queue_(program, "scatter_queue", groups.traversal, profile, QUEUE_CHUNK),
      move_paths_(program, "move_paths", groups.traversal, profile),
      accumulate_(program, "accumulate", groups.streaming, profile),
      fold_film_(program, "fold_film", groups.streaming, profile) {}

bool QueueManager::render(
    const Window& window, RenderParams params, Film& film, const std::function<bool()>& stop) {
    start(window, params);
    uint32_t slots =
        std::min(pool_.slots, static_cast<uint32_t>(window.pixels * window.rows.size()));
    Work work{slots, 0};
    closest_rays_ += slots;
    assign_units_.launch(
        device_, slots, params_, slots, plan_, pool_.hits, pool_.ids, pool_.radiances);
    uint64_t iteration = 0;
    uint64_t last_iteration = std::numeric_limits<uint64_t>::max();
    bool stopping = false;
    while (work.active > 0 && iteration < last_iteration) {
        generate_rays_.launch(
            device_, slots, params_, slots, plan_, pool_.hits, pool_.ids, pool_.rays,
            pool_.throughputs, pool_.radiances, pool_.media);
        intersect_.launch(
            device_, slots, params_, slots, scene_.nodes, scene_.blocks, scene_.mesh,
            scene_.triangles, scene_.materials, scene_.textures, pool_.rays, pool_.media, pool_.ids,
            pool_.hits);
        if (work.active <= slots / 2) slots = compact(slots, work.active);
        if (find_contacts_)
            find_contacts_->launch(
                device_, slots, params_, slots, scene_.nodes, scene_.blocks, scene_.triangles,
                scene_.materials, scene_.textures, pool_.rays, pool_.media, pool_.ids, pool_.hits);
        if (sample_distance_)
            sample_distance_->launch(
                device_, slots, params_, slots, scene_.triangles, scene_.lights, scene_.media,
                pool_.rays, pool_.media, pool_.hits, pool_.surfaces, pool_.throughputs,
                pool_.radiances, pool_.ids, pool_.branches);
        interact_.launch(
            device_, slots, params_, slots, scene_.triangles, scene_.materials, pool_.rays,
            pool_.hits, pool_.surfaces);
        if (apply_textures_)
            apply_textures_->launch(
                device_, slots, params_, slots, scene_.triangles, scene_.materials, scene_.textures,
                pool_.rays, pool_.hits, pool_.surfaces);
        if (decide_boundary_)
            decide_boundary_->launch(
                device_, slots, params_, slots, scene_.materials, pool_.rays, pool_.hits, pool_.ids,
                pool_.surfaces);
        if (pass_boundary_)
            pass_boundary_->launch(
                device_, slots, params_, slots, scene_.triangles, scene_.materials, pool_.rays,
                pool_.surfaces, pool_.media, pool_.hits, pool_.throughputs);
        if (shade_miss_)
            shade_miss_->launch(
                device_, slots, params_, slots, scene_.environment, pool_.rays, pool_.hits,
                pool_.throughputs, pool_.radiances);
        if (shade_emission_)
            shade_emission_->launch(
                device_, slots, params_, slots, scene_.triangles, scene_.materials, scene_.lights,
                scene_.textures, pool_.rays, pool_.hits, pool_.surfaces, pool_.throughputs,
                pool_.radiances);
        if (direct_light_)
            direct_light_->launch(
                device_, slots, params_, slots, scene_.triangles, scene_.materials, scene_.lights,
                scene_.environment, scene_.media, scene_.textures, pool_.rays, pool_.hits,
                pool_.surfaces, pool_.throughputs, pool_.ids, pool_.media, pool_.shadows);
        if (occlusion_)
            occlusion_->launch(
                device_, slots, params_, slots, scene_.nodes, scene_.blocks, scene_.mesh,
                scene_.triangles, scene_.textures, pool_.shadows, pool_.ids, pool_.radiances,
                pool_.fates);
        if (connect_through_media_)
            connect_through_media_->launch(
                device_, slots, params_, slots, scene_.nodes, scene_.blocks, scene_.triangles,
                scene_.materials, scene_.media, scene_.textures, pool_.shadows, pool_.ids,
                pool_.radiances, pool_.fates);
        if (pass_walls_)
            pass_walls_->launch(
                device_, slots, params_, slots, scene_.triangles, scene_.materials, pool_.rays,
                pool_.surfaces, pool_.ids, pool_.media, pool_.hits, pool_.throughputs);
        first_hit_.launch(
            device_, slots, params_, slots, pool_.hits, pool_.surfaces, pool_.ids, pool_.radiances);
        if (refract_boundary_)
            refract_boundary_->launch(
                device_, slots, params_, slots, scene_.triangles, scene_.materials, scene_.media,
                pool_.surfaces, pool_.rays, pool_.media, pool_.hits, pool_.throughputs, pool_.ids);
        sample_indirect_.launch(
            device_, slots, params_, slots, scene_.materials, pool_.surfaces, pool_.rays,
            pool_.hits, pool_.throughputs, pool_.ids, pool_.media, pool_.branches);
        if (scatter_medium_)
            scatter_medium_->launch(
                device_, slots, params_, slots, scene_.media, pool_.surfaces, pool_.media,
                pool_.rays, pool_.hits, pool_.throughputs, pool_.ids, pool_.branches);
        roulette_compact_.launch(
            device_, slots, params_, slots, scene_.media, pool_.media, pool_.ids, pool_.hits,
            pool_.throughputs, pool_.fates);
        if (resume_branch_)
            resume_branch_->launch(
                device_, slots, params_, slots, pool_.branches, pool_.hits, pool_.rays,
                pool_.throughputs, pool_.ids, pool_.media, pool_.fates);
        accumulate_.launch(
            device_, slots, params_, slots, pool_.hits, pool_.throughputs, pool_.radiances,
            pool_.ids, cells_, cell_flags_);
        work = count_work(slots, work);
        ++iteration;
        if (!stopping && stop()) {
            stopping = true;
            last_iteration = iteration + std::max(iteration, grace);
        }
    }
    const bool whole = work.active == 0;
    if (whole) {
        const FilmBand& band = film.band_of(window.first_pixel);
        fold_film_.launch(
            device_, window.pixels, params_, plan_, cells_, cell_flags_, band.planes, band.flags);
        cut_.add(window_cut_);
    }
    device_.queue.finish();
    profile_.collect();
    counts_.clear();
    iterations_ += iteration;
    return whole;
}

void QueueManager::start(const Window& window, RenderParams params) {
    image_width_ = params.width;
    window_cut_ = {};
    params.stride = pool_.stride;
    params.first_pixel = window.first_pixel;
    params.window_pixels = window.pixels;
    params.cells = static_cast<cl_uint>(window.pixels * window.rows.size());
    params.pool = std::min(pool_.slots, params.cells);
    params.pixel_step = params.pool % window.pixels;
    params.pass_step = params.pool / window.pixels;
    device_.queue.enqueueWriteBuffer(params_.buffer(), CL_TRUE, 0, sizeof(params), &params);
    device_.queue.enqueueWriteBuffer(
        plan_.buffer(), CL_TRUE, 0, window.rows.size() * sizeof(PlanRow), window.rows.data());
}

void QueueManager::load_compaction() {
    const cl_uint slots = 1;
    const cl_uint kept = QUEUE_CHUNK;  // nothing lies above and moves
    scatter_queue_.launch(
        device_, 1, params_, slots, kept, pool_.hits, pool_.chunk_states, pool_.holes,
        pool_.movers);
    move_paths_.launch(
        device_, 1, params_, pool_.holes, pool_.movers, pool_.rays, pool_.hits, pool_.throughputs,
        pool_.radiances, pool_.ids, pool_.media, pool_.branches);
    device_.queue.finish();
}

QueueManager::Work QueueManager::count_work(uint32_t slots, const Work& before) {
    const uint32_t chunks = (slots + QUEUE_CHUNK - 1) / QUEUE_CHUNK;
    scan_queue_.launch(
        device_, slots, params_, slots, pool_.fates, pool_.ids, pool_.chunk_states,
        pool_.statistics);
    Count& count = counts_.emplace_back();
    count.chunks.resize(chunks);
    device_.queue.enqueueReadBuffer(
        pool_.chunk_states.buffer(), CL_FALSE, 0, chunks * sizeof(ChunkState), count.chunks.data(),
        nullptr, &count.arrival);
    device_.queue.flush();
    if (counts_.size() <= count_lag_) return before;
    counts_.front().arrival.wait();
    Work work;
    for (const ChunkState& chunk : counts_.front().chunks) {
        work.active += chunk.active;
        work.resumed += chunk.resumed;
        window_cut_.add(
            {chunk.cut, chunk.cut_pixel % image_width_, chunk.cut_pixel / image_width_,
             chunk.cut_sample});
    }
    counts_.pop_front();
    closest_rays_ += work.active - work.resumed;
    return work;
}

uint32_t QueueManager::compact(uint32_t slots, uint32_t active) {
    const uint32_t kept = (active + QUEUE_CHUNK - 1) / QUEUE_CHUNK * QUEUE_CHUNK;
    if (kept >= slots) return slots;
    scatter_queue_.launch(
        device_, slots, params_, slots, kept, pool_.hits, pool_.chunk_states, pool_.holes,
        pool_.movers);
    move_paths_.launch(
        device_, std::min(active, slots - kept), params_, pool_.holes, pool_.movers, pool_.rays,
        pool_.hits, pool_.throughputs, pool_.radiances, pool_.ids, pool_.media, pool_.branches);
    return kept;
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
