// The options of all that renders.
#pragma once

#include "gltf/gltf_loader.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace wavepath {

struct RenderOptions {
    std::filesystem::path scene;
    std::string size;           // "WxH"; empty: 512 high, the camera's aspect ratio
    std::string scene_of_file;  // name or index; empty: the file's default
    std::string camera;
    std::string look_at;
    std::optional<double> fov;  // [degrees] vertical
    std::optional<uint64_t> spp;
    std::optional<double> time;  // [s]
    std::optional<double> target_error;
    uint32_t seed = 1;
    std::string device;
    std::string method = "mis";
    std::string termination = "roulette";
    std::string guide = "on";
    std::string light_choice;  // empty: the method's own
    std::string sampler = "sobol";
    std::string layering = "conserving";
    std::string distance = "exponential";
    std::string direction = "phase";
    std::string splits = "1,1,1";
    uint32_t split_depth = 1;
    std::filesystem::path environment;
    std::string environment_radiance;
    double lumens_per_watt = 1;
    uint32_t pool = 0;
    uint64_t max_texels = default_most_texels >> 20U;  // [2^20]
};

void add_render_options(CLI::App& app, RenderOptions& options);

// Those of them that change how a picture is computed and not what it shows.
void add_variant_options(CLI::App& app, RenderOptions& options);

}  // namespace wavepath
