#include "wavefront/queue_manager.h"

#include "device/program.h"
#include "wavefront/chain.h"
#include "wavefront/megakernel.h"
#include "wavefront/sample_plan.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace wavepath {

namespace {

// Iterations for a window to end by itself after a request to stop.
constexpr uint64_t grace = 1000;

void name_film(KernelBuffers& buffers, const FilmBand& band) {
    buffers.add("film", band.planes, Access::write);
    buffers.add("film_flags", band.flags, Access::write);
}

LaunchSize launch_size(Shape shape, const Features& features, const WorkGroups& groups) {
    switch (shape) {
        case Shape::slots:
            return {groups.streaming};
        case Shape::traversal:
            return {groups.traversal};
        case Shape::rays:
            return {features.rays_per_item > 1 ? 1 : groups.traversal, features.rays_per_item};
        case Shape::chunks:
            return {groups.traversal, QUEUE_CHUNK};
    }
    return {};
}

}  // namespace

void CutPaths::add(const CutPaths& more) {
    if (more.count == 0) return;
    if (count == 0 || std::tie(more.y, more.x, more.sample) < std::tie(y, x, sample))
        std::tie(x, y, sample) = std::tie(more.x, more.y, more.sample);
    count += more.count;
}

KernelBuffers name_buffers(
    const SceneBuffers& scene, const PathPool& pool, const WindowBuffers& window) {
    KernelBuffers buffers;
    scene.name(buffers);
    pool.name(buffers);
    window.name(buffers);
    name_film(buffers, {});  // another one for every window
    return buffers;
}

std::string QueueManager::source_of(const Features& features) {
    std::vector<std::string> files;
    visit_stages(features, [&](const std::string& stage, Shape = Shape::slots) {
        files.push_back("stages/" + stage + ".cl");
    });
    std::string source = assemble_source(features.defines(), files);
    if (features.megakernel) source += megakernel_text(features, source);
    return source;
}

QueueManager::QueueManager(
    const Device& device,
    const cl::Program& program,
    const std::string& source,
    const Features& features,
    const SceneBuffers& scene,
    uint32_t slots,
    uint64_t max_cells,
    WorkGroups groups,
    uint32_t count_lag,
    Profile& profile)
    : device_(device),
      features_(features),
      profile_(profile),
      pool_(device, slots, features),
      window_(device, max_cells),
      count_lag_(count_lag) {
    const KernelBuffers buffers = name_buffers(scene, pool_, window_);
    const auto add = [&](const std::string& stage, Shape shape = Shape::slots) {
        stages_.try_emplace(
            stage, program, source, stage, buffers, launch_size(shape, features, groups), profile);
    };
    visit_stages(features, add);
    if (features.megakernel) add("megakernel", Shape::traversal);
}

bool QueueManager::render(
    const Window& window, RenderParams params, Film& film, const std::function<bool()>& stop) {
    start(window, params);
    uint32_t slots =
        std::min(pool_.slots, static_cast<uint32_t>(window.pixels * window.rows.size()));
    Work work{slots, 0};
    closest_rays_ += slots;
    launch("assign_units", slots);
    if (features_.megakernel) {
        launch("megakernel", slots);
        work = {};
    }
    uint64_t iteration = 0;
    uint64_t last_iteration = std::numeric_limits<uint64_t>::max();
    bool stopping = false;
    while (work.active > 0 && iteration < last_iteration) {
        iterate(
            features_, [&](const char* stage, Shape = Shape::slots) { launch(stage, slots); },
            [&] {
                if (work.active <= slots / 2) slots = compact(slots, work.active);
            });
        work = count_work(slots, work);
        ++iteration;
        if (!stopping && stop()) {
            stopping = true;
            last_iteration = iteration + std::max(iteration, grace);
        }
    }
    const bool whole = work.active == 0;
    if (whole) {
        KernelBuffers band;
        name_film(band, film.band_of(window.first_pixel));
        Stage& fold_film = stages_.at("fold_film");
        fold_film.rebind(band);
        fold_film.launch(device_, window.pixels, {});
        cut_.add(window_cut_);
    }
    device_.queue.finish();
    profile_.collect();
    counts_.clear();
    iterations_ += iteration;
    return whole;
}

void QueueManager::launch(const char* stage, uint32_t slots) {
    stages_.find(stage)->second.launch(device_, slots, {slots});
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
    device_.queue.enqueueWriteBuffer(
        window_.settings.buffer(), CL_TRUE, 0, sizeof(params), &params);
    device_.queue.enqueueWriteBuffer(
        window_.plan.buffer(), CL_TRUE, 0, window.rows.size() * sizeof(PlanRow),
        window.rows.data());
}

void QueueManager::load_compaction() {
    const cl_uint slots = 1;
    const cl_uint kept = QUEUE_CHUNK;  // nothing lies above and moves
    stages_.at("scatter_queue").launch(device_, slots, {slots, kept});
    stages_.at("move_paths").launch(device_, 1, {});
    device_.queue.finish();
}

QueueManager::Work QueueManager::count_work(uint32_t slots, const Work& before) {
    const uint32_t chunks = (slots + QUEUE_CHUNK - 1) / QUEUE_CHUNK;
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
    stages_.at("scatter_queue").launch(device_, slots, {slots, kept});
    stages_.at("move_paths").launch(device_, std::min(active, slots - kept), {});
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
    return pool_.bytes() + window_.bytes();
}

}  // namespace wavepath
