// The chain of kernels: from units of work to cells to the film.
#pragma once

#include "film/film.h"
#include "wavefront/features.h"
#include "wavefront/path_pool.h"
#include "wavefront/scene_buffers.h"
#include "wavefront/stage.h"
#include "wavefront/window_buffers.h"

#include <deque>
#include <functional>
#include <map>

namespace wavepath {

// A band of the film, pixels [first_pixel, first_pixel + pixels), and the passes to take
// through them.
struct Window {
    uint32_t first_pixel = 0;
    uint32_t pixels = 0;
    std::vector<PlanRow> rows;
};

struct WorkGroups {
    uint32_t traversal = 64;
    uint32_t streaming = 256;
};

struct RayCounts {
    std::vector<uint64_t> path_lengths;  // paths that ended after 1, 2, ... closest-hit rays; the
                                         // last of DEPTH_BINS: and more
    uint64_t closest = 0;                // rays traced by intersect
    uint64_t connections = 0;            // rays traced by occlusion
};

// Paths ended at MAX_SCATTERINGS: what they would still have brought is missing in the picture.
struct CutPaths {
    uint64_t count = 0;
    uint32_t x = 0, y = 0, sample = 0;  // the first, in order of pixels and samples

    void add(const CutPaths& more);
};

// Every buffer that a stage may ask for.
KernelBuffers name_buffers(
    const SceneBuffers& scene, const PathPool& pool, const WindowBuffers& window);

class QueueManager {
  public:
    // `program`: built from `source`, which is source_of(features). `scene` must outlive this.
    // `max_cells`: the most units of work of one window. `count_lag`: iterations by which the host
    // learns late how many slots have work. 0: launches are exact, and the device waits for the
    // host; 1: it never waits, and idle slots return at their guards.
    QueueManager(
        const Device& device,
        const cl::Program& program,
        const std::string& source,
        const Features& features,
        const SceneBuffers& scene,
        uint32_t slots,
        uint64_t max_cells,
        WorkGroups work_groups,
        uint32_t count_lag,
        Profile& profile);

    // The program of the chain that these features need.
    static std::string source_of(const Features& features);

    // Takes the window's samples and folds them into the film. `params` says all but the window.
    // `stop` is asked every iteration. From when it says true the window gets as many more as it
    // has had, or 1000: the return value says whether it is whole; if not, the film is as before.
    bool render(
        const Window& window,
        RenderParams params,
        Film& film,
        const std::function<bool()>& stop = [] { return false; });

    // Loads the kernels of the compaction, which a short render does not reach.
    void load_compaction();

    RayCounts ray_counts() const;
    uint64_t iterations() const { return iterations_; }
    // Of all whole windows.
    const CutPaths& cut_paths() const { return cut_; }
    std::size_t bytes() const;

  private:
    // Launches a stage whose numbers are `slots` alone.
    void launch(const char* stage, uint32_t slots);
    void start(const Window& window, RenderParams params);
    struct Work {
        uint32_t active = 0;   // slots with work,
        uint32_t resumed = 0;  // of which these need no ray
    };

    // What scan_queue counted, on its way to the host.
    struct Count {
        std::vector<ChunkState> chunks;
        cl::Event arrival;
    };

    // The work as scan_queue finds it, `count_lag` iterations late: then what it was, a bound.
    Work count_work(uint32_t slots, const Work& before);
    // Moves the live paths, at most `active`, of `slots` slots together; returns how many slots
    // they take.
    uint32_t compact(uint32_t slots, uint32_t active);

    const Device& device_;
    Features features_;
    Profile& profile_;
    PathPool pool_;
    WindowBuffers window_;
    uint32_t count_lag_;
    std::deque<Count> counts_;
    uint64_t iterations_ = 0;
    uint64_t closest_rays_ = 0;
    CutPaths cut_;
    CutPaths window_cut_;
    uint32_t image_width_ = 1;

    std::map<std::string, Stage, std::less<>> stages_;
};

}  // namespace wavepath
