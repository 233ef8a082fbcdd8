// Renders that stay in a folder, so that a chart half done goes on where it was.
#pragma once

#include "commands/chart/variant.h"
#include "device/device.h"
#include "image/image.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace wavepath {

struct KeptRender {
    Image image;         // R, G, B, with the metadata that render_command reads
    double seconds = 0;  // of rendering: without loading and compiling
    std::string bias;    // what it does to the expected value; empty: nothing
    uint64_t nonfinite_samples = 0;
};

// By selector.
using Devices = std::map<std::string, Device>;

// Those of the variants and `more`: others before PoCL, which would leave the loader nothing else
// (open_device).
Devices open_devices(const std::vector<Variant>& variants, const std::string& more);

class KeptRenders {
  public:
    // Of `job`'s scene, in `folder`, which is made. `files`: that the scene was read from.
    KeptRenders(
        std::filesystem::path folder,
        const RenderJob& job,
        std::vector<std::filesystem::path> files,
        const Devices& devices);

    // The picture of `samples` a pixel from `seed`: from the folder, if it was made by the same
    // program, device, settings and scene file, else rendered now. Throws Interrupted where `stop`
    // says so before its end; the picture is then not kept.
    KeptRender get(
        const Variant& variant, uint64_t samples, uint32_t seed, const std::function<bool()>& stop);

    // How many were rendered, and found.
    std::size_t rendered() const { return rendered_; }
    std::size_t found() const { return found_; }

  private:
    std::filesystem::path folder_;
    RenderJob job_;
    std::vector<std::filesystem::path> files_;
    const Devices& devices_;
    std::size_t rendered_ = 0;
    std::size_t found_ = 0;
};

}  // namespace wavepath
