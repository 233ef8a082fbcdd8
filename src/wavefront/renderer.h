// From a scene and settings to a finished picture.
#pragma once

#include "device/profile.h"
#include "device/program.h"
#include "film/film.h"
#include "film/outlier.h"
#include "scene/scene.h"
#include "wavefront/method.h"
#include "wavefront/queue_manager.h"

#include <functional>
#include <string>
#include <vector>

namespace wavepath {

struct RenderSettings {
    uint32_t width = 512, height = 512;
    Camera camera;
    uint64_t samples = 64;    // a pixel; 0: open-ended, until `seconds` or `target_error`
    double seconds = 0;       // stop after the pass that passes it; 0: no limit
    double target_error = 0;  // stop when DevelopedFilm::relative_error falls below; 0: no target
    uint32_t seed = 1;
    Method method = method_named("mis");
    Termination termination;
    Splits splits;
    uint32_t split_depth = 1;
    bool sobol = true;
    bool layers_conserve = true;  // below specular layers, as materials; false: by glTF's letter
    uint32_t pool = 0;            // path slots; 0: the device's default
    Kernels kernels = Kernels::specialised;
    WorkGroups work_groups;
    std::optional<uint32_t> count_lag;  // QueueManager's; none: 0 on a CPU, 1 elsewhere

    // What the settings do to the expected value; empty: nothing.
    std::string bias() const;
};

struct RenderTimes {
    double normalise = 0, bvh_build = 0, upload = 0, program_build = 0, render = 0;  // [s]
};

struct RenderProgress {
    uint64_t samples = 0;         // a pixel, so far
    uint64_t samples_wanted = 0;  // 0: open-ended
    double seconds = 0;           // of rendering
    uint64_t rays = 0;
    std::function<double()> relative_error;  // reads the film back
};

struct RenderResult {
    DevelopedFilm film;
    Outlier outlier;       // of the film
    uint64_t samples = 0;  // a pixel
    uint32_t batches = 0;  // that the variance rests on
    RenderTimes times;
    BuildReport program;
    std::vector<ProfileRow> profile;
    bool device_clock = true;
    RayCounts rays;
    CutPaths cut_paths;
    uint64_t iterations = 0;
    std::size_t triangles = 0, dropped_triangles = 0, lights = 0, bvh_nodes = 0, bvh_blocks = 0;
    std::size_t scene_bytes = 0, pool_bytes = 0, film_bytes = 0;  // on the device
    std::size_t texture_bytes = 0;                                // of scene_bytes
    uint32_t texture_pages = 0;
    std::vector<std::string> warnings;
    bool guided = false;  // directions were aimed at the lamps' surroundings
    bool interrupted = false;
};

// What settings and cut paths do to the expected value; empty: nothing.
std::string bias_of(const RenderSettings& settings, const RenderResult& result);

struct UploadedScene;

// `progress` is called after every pass over the picture. `stop` is asked all the time: once it
// says true the render ends with its pass, or without it where a path does not end
// (QueueManager::render), and the result is `interrupted`.
// Throws Error where the device lacks memory, before rendering. `settings`: those of upload(), of
// which `pool`, `kernels` and `work_groups` may differ.
RenderResult render(
    const Device& device,
    const UploadedScene& uploaded,
    const RenderSettings& settings,
    const std::function<void(const RenderProgress&)>& progress = {},
    const std::function<bool()>& stop = [] { return false; });

// The same with upload(), once.
RenderResult render(
    const Device& device,
    const Scene& scene,
    const RenderSettings& settings,
    const std::function<void(const RenderProgress&)>& progress = {},
    const std::function<bool()>& stop = [] { return false; });

}  // namespace wavepath
