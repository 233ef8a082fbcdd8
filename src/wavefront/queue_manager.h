// The chain of kernels: from units of work to cells to the film.
#pragma once

#include "device/scene_buffers.h"
#include "film/film.h"
#include "shared/film.h"
#include "shared/params.h"
#include "wavefront/features.h"
#include "wavefront/path_pool.h"
#include "wavefront/stage.h"

#include <optional>

namespace wavepath {

// Pixels [first_pixel, first_pixel + pixels) and the passes to take through them.
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
    std::vector<uint64_t> path_lengths;  // paths that ended after 1, 2, ... closest-hit rays; the last of DEPTH_BINS: and more
    uint64_t closest = 0;                // rays traced by intersect
    uint64_t connections = 0;            // rays traced by occlusion
};

class QueueManager {
  public:
    // `max_cells`: the most units of work of one window.
    QueueManager(
        const Device& device, const cl::Program& program, const Features& features, const SceneBuffers& scene, uint32_t slots,
        uint64_t max_cells, WorkGroups work_groups, Profile& profile);

    // The kernel files of the chain that these features need.
    static std::vector<std::string> kernel_files(const Features& features);


    // Takes the window's samples and folds them into the film. `params` says all but the window.
    // Throws Error for a path of MAX_SCATTERINGS.
    void render(const Window& window, RenderParams params, Film& film);

    RayCounts ray_counts() const;
    uint64_t iterations() const { return iterations_; }
    std::size_t bytes() const;

  private:
    template <typename T>
    using Array = DeviceArray<T>;
    using Params = Array<RenderParams>;
    using Sizes = Array<QueueSizes>;
    using Floats = Array<cl_float>;
    using Uints = Array<cl_uint>;
    using Plan = Array<PlanRow>;

    QueueSizes read_sizes(const Sizes& sizes);
    [[noreturn]] void report_runaway(const QueueSizes& sizes, const Window& window) const;

    const Device& device_;
    const Features features_;
    const SceneBuffers& scene_;
    Profile& profile_;
    PathPool pool_;
    Params params_;
    Plan plan_;
    Floats cells_;
    Uints cell_flags_;
    uint64_t iterations_ = 0;
    uint64_t closest_rays_ = 0;

    Stage<Params, Uints, Uints, Sizes, Uints, Floats> assign_units_;
    Stage<Params, Sizes, Uints, Plan, Uints, Floats, Floats, Floats> generate_rays_;
    Stage<Params, Sizes, Uints, Array<BvhNode>, Array<TriangleBlock>, Floats, Floats> intersect_;
    Stage<Params, Sizes, Uints, Floats, Array<DeviceMaterial>, Floats, Floats, Floats> first_hit_;
    std::optional<Stage<Params, Sizes, Uints, Array<EnvironmentEntry>, Floats, Floats, Floats, Floats>> shade_miss_;
    std::optional<Stage<Params, Sizes, Uints, Floats, Array<DeviceMaterial>, Array<DeviceLight>, Floats, Floats, Floats, Floats>>
        shade_emission_;
    std::optional<Stage<Params, Sizes, Uints, Floats, Array<DeviceMaterial>, Array<DeviceLight>, Array<EnvironmentEntry>, Floats,
        Floats, Floats, Uints, Floats>>
        direct_light_;
    std::optional<Stage<Params, Sizes, Uints, Array<BvhNode>, Array<TriangleBlock>, Floats, Floats, Array<cl_uchar>>> occlusion_;
    Stage<Params, Sizes, Uints, Floats, Array<DeviceMaterial>, Floats, Floats, Floats, Uints> sample_indirect_;
    Stage<Params, Sizes, Uints, Plan, Uints, Floats, Floats, Array<cl_uchar>> roulette_compact_;
    Stage<Sizes, Array<cl_uchar>, Array<cl_uint2>> scan_queue_;
    Stage<Params, Sizes, Uints, Array<cl_uchar>, Array<cl_uint2>, Uints, Uints, Uints, Sizes, Uints> scatter_queue_;
    Stage<Params, Sizes, Uints, Plan, Floats, Uints, Floats, Uints> accumulate_;
    Stage<Params, Plan, Floats, Uints, Floats, Uints> fold_film_;
};

}  // namespace wavepath
