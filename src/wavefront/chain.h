// The chain of stages, in order: what is listed, built and, one segment after the other, launched.
#pragma once

#include "wavefront/features.h"

namespace wavepath {

// How many work-items a stage launches.
enum class Shape {
    slots,      // one a slot
    traversal,  // one a slot, in small work-groups
    rays,       // one for Features::rays_per_item slots, in the smallest
    chunks,     // one a chunk of QUEUE_CHUNK slots
};

// One segment of every path. run(name, shape = Shape::slots) takes a stage; compact() may move the
// paths together.
template <typename Run, typename Compact>
void iterate(const Features& f, Run&& run, Compact&& compact) {
    run("generate_rays");
    run("intersect", Shape::rays);
    compact();
    if (f.contacts) run("find_contacts", Shape::traversal);
    if (f.media) run("sample_distance");
    run("interact");
    if (f.textures) run("apply_textures");
    if (f.partial_boundaries) run("decide_boundary");
    if (f.media) run("pass_boundary");
    if (f.environment) run("shade_miss");
    if (f.area_lights) run("shade_emission");
    if (f.sample_lights) run("direct_light");
    if (f.connections_by_occlusion()) run("occlusion", Shape::rays);
    if (f.connections_by_hits()) run("connect_through_media", Shape::traversal);
    if (f.smooth_walls) run("pass_walls");
    run("first_hit");
    if (f.dielectrics) run("refract_boundary");
    run("sample_indirect");
    if (f.media_scatter) run("scatter_medium");
    run("roulette_compact");
    if (f.split_levels > 0) run("resume_branch");
    run("accumulate");
    run("scan_queue", Shape::chunks);
}

// Every stage of a window, once. Those around the segments are launched by QueueManager, by name.
template <typename Run>
void visit_stages(const Features& f, Run&& run) {
    run("assign_units");
    iterate(f, run, [&] {
        run("scatter_queue", Shape::chunks);
        run("move_paths", Shape::traversal);
    });
    run("fold_film");
}

}  // namespace wavepath
