// What options amount to: a scene, and the settings to render it.
#pragma once

#include "commands/render_options.h"
#include "wavefront/renderer.h"

namespace wavepath {

// All settings but camera and size, which take the scene. Throws Error for options that contradict
// each other or their own syntax.
RenderSettings parse_settings(const RenderOptions& options);

// A scene as the options name and light it, with the settings to render it. Throws Error for
// options that contradict each other, the scene, or their own syntax.
struct RenderJob {
    Scene scene;
    RenderSettings settings;
    std::string scene_of_file;   // as it was asked for; empty: the file's default
    double lumens_per_watt = 1;  // by which the intensities of punctual lights were divided
    double load_seconds = 0;
};

RenderJob prepare_job(const RenderOptions& options);

}  // namespace wavepath
