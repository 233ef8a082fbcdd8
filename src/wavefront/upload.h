// A scene on a device, for any number of renders.
#pragma once

#include "prepare/prepared_scene.h"
#include "shared/params.h"
#include "wavefront/renderer.h"
#include "wavefront/scene_buffers.h"

#include <string>
#include <vector>

namespace wavepath {

// NOLINTNEXTLINE(bugprone-exception-escape): see Device
struct UploadedScene {
    const Scene& scene;
    PreparedScene prepared;
    RenderParams params = {};  // all but the window's
    SceneBuffers buffers = {};
    std::vector<std::string> warnings = {};
    RenderTimes times = {};  // up to its upload
};

// `scene` must outlive what this returns. Throws Error where the scene has no light, or none that
// the method can find, and for splits that it can't branch by. Only what is uploaded for
// Kernels::full_features can be rendered by them, and by all others as well.
UploadedScene upload(const Device& device, const Scene& scene, const RenderSettings& settings);

}  // namespace wavepath
