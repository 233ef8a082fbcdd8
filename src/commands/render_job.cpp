#include "commands/render_job.h"

#include "error.h"
#include "scene/camera.h"
#include "scene/environment_map.h"
#include "stopwatch.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace wavepath {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr uint32_t default_height = 512;
constexpr uint32_t largest_side = 1U << 15U;

// Exactly N finite numbers separated by commas.
template <std::size_t N>
std::array<double, N> parse_numbers(const char* option, const std::string& text, const char* form) {
    std::array<double, N> values{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < N; ++i) {
        const auto [rest, error] = std::from_chars(at, end, values[i]);
        const bool separated = i + 1 < N ? rest < end && *rest == ',' : rest == end;
        if (error != std::errc{} || !separated || !std::isfinite(values[i]))
            throw Error("{} {}: use {}", option, text, form);
        at = rest + 1;
    }
    return values;
}

void parse_size(const std::string& text, const Camera& camera, RenderSettings& settings) {
    if (text.empty()) {
        const double aspect =
            camera.orthographic ? camera.x_mag / camera.y_mag : camera.aspect_ratio;
        settings.height = default_height;
        settings.width = aspect > 0
                             ? static_cast<uint32_t>(std::clamp(
                                   std::lround(default_height * aspect), 1L, long{largest_side}))
                             : default_height;
        return;
    }
    const std::size_t cross = text.find('x');
    const auto side = [&](std::string_view digits, uint32_t& value) {
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc{} && end == digits.data() + digits.size() && value >= 1 &&
               value <= largest_side;
    };
    if (cross == std::string::npos ||
        !side(std::string_view(text).substr(0, cross), settings.width) ||
        !side(std::string_view(text).substr(cross + 1), settings.height))
        throw Error(
            "--size {}: use WxH in pixels, each from 1 to {}, for example 512x512", text,
            largest_side);
}

Camera parse_camera(const RenderOptions& options, const Scene& scene) {
    Camera camera;
    if (options.look_at.empty()) {
        camera = choose_camera(scene, options.camera);
        if (options.camera.empty() && scene.cameras.size() > 1)
            spdlog::info(
                "camera \"{}\" is the first of {}; others by --camera", camera.name,
                scene.cameras.size());
    } else {
        if (!options.camera.empty()) throw Error("--camera and --look-at: give one of them");
        const auto v = parse_numbers<6>("--look-at", options.look_at, "ex,ey,ez,tx,ty,tz [m]");
        camera = look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, 45 * degree);
    }
    if (options.fov) {
        if (!(*options.fov > 0 && *options.fov < 180))
            throw Error("--fov {}: use degrees between 0 and 180", *options.fov);
        if (camera.orthographic)
            throw Error(
                "--fov: camera \"{}\" is orthographic; choose another or use --look-at",
                camera.name);
        camera.y_fov = *options.fov * degree;
    }
    return camera;
}

void parse_budget(const RenderOptions& options, RenderSettings& settings) {
    const int budgets = int{options.spp.has_value()} + int{options.time.has_value()} +
                        int{options.target_error.has_value()};
    if (budgets > 1) throw Error("--spp, --time and --target-error: give one of them");
    if (options.spp) settings.samples = *options.spp;
    if (options.time) {
        if (!(*options.time > 0) || !std::isfinite(*options.time))
            throw Error("--time {}: use seconds above 0", *options.time);
        settings.samples = 0;
        settings.seconds = *options.time;
    }
    if (options.target_error) {
        if (!(*options.target_error > 0) || !std::isfinite(*options.target_error))
            throw Error(
                "--target-error {}: use a relative error above 0, for example 0.01",
                *options.target_error);
        settings.samples = 0;
        settings.target_error = *options.target_error;
    }
}

std::optional<Environment> parse_environment(const RenderOptions& options) {
    const bool constant = !options.environment_radiance.empty();
    if (options.environment.empty() && !constant) return std::nullopt;
    Environment environment;
    environment.radiance = {1, 1, 1};
    if (!options.environment.empty()) environment = load_environment_map(options.environment);
    if (!constant) return environment;
    const auto rgb = parse_numbers<3>(
        "--env-radiance", options.environment_radiance, "R,G,B radiance, each 0 or more");
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(rgb[c] >= 0 && rgb[c] <= 1e30))
            throw Error(
                "--env-radiance {}: radiance is 0 or more, and 1e30 at the most",
                options.environment_radiance);
        environment.radiance[c] = static_cast<float>(rgb[c]);
    }
    if (rgb[0] + rgb[1] + rgb[2] <= 0) return std::nullopt;
    return environment;
}

}  // namespace

RenderSettings parse_settings(const RenderOptions& options) {
    RenderSettings settings;
    settings.method = method_named(options.method);
    if (!options.light_choice.empty())
        settings.method.light_choice =
            options.light_choice == "area" ? LightChoice::area : LightChoice::power;
    settings.method.guide = settings.method.guide && options.guide == "on";
    settings.method.distances = distances_named(options.distance);
    settings.method.phase_directions = options.direction == "phase";
    settings.termination = parse_termination(options.termination);
    settings.splits = parse_splits(options.splits);
    settings.split_depth = options.split_depth;
    settings.sobol = options.sampler == "sobol";
    settings.layers_conserve = options.layering == "conserving";
    settings.seed = options.seed;
    settings.pool = options.pool;
    parse_budget(options, settings);
    return settings;
}

RenderJob prepare_job(const RenderOptions& options) {
    RenderJob job;
    job.settings = parse_settings(options);
    job.scene_of_file = options.scene_of_file;
    if (!(options.lumens_per_watt > 0) || !std::isfinite(options.lumens_per_watt))
        throw Error(
            "--lumens-per-watt {}: use a number above 0, 683 for lights in candela and lux",
            options.lumens_per_watt);

    Stopwatch watch;
    job.scene = load_gltf(
        options.scene, options.scene_of_file, options.max_texels << 20U, options.lumens_per_watt);
    job.lumens_per_watt = options.lumens_per_watt;
    job.scene.environment = parse_environment(options);
    job.settings.camera = parse_camera(options, job.scene);
    parse_size(options.size, job.settings.camera, job.settings);
    job.load_seconds = watch.lap();
    return job;
}

}  // namespace wavepath
