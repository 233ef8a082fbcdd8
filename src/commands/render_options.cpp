#include "commands/render_options.h"

#include "error.h"
#include "gltf/gltf_loader.h"
#include "scene/camera.h"
#include "scene/environment_map.h"
#include "stopwatch.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
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

// Adds options under one heading of --help.
class OptionGroup {
  public:
    OptionGroup(CLI::App& app, std::string heading) : app_(app), heading_(std::move(heading)) {}

    template <typename T>
    CLI::Option* add(
        const std::string& name, T& value, const std::string& type, const std::string& text) {
        return app_.add_option(name, value, text)->type_name(type)->group(heading_);
    }

    // One of these words.
    void add_choice(
        const std::string& name,
        std::string& value,
        const std::vector<std::string>& words,
        const std::string& text) {
        add(name, value, "NAME", text)->check(CLI::IsMember(words));
    }

    template <typename T, typename Number>
    void add_number(
        const std::string& name,
        T& value,
        const std::string& type,
        Number least,
        Number most,
        const std::string& text) {
        add(name, value, type, text)->check(CLI::Range(least, most));
    }

  private:
    CLI::App& app_;
    std::string heading_;
};

void add_view_options(OptionGroup group, RenderOptions& o) {
    group.add(
        "--size", o.size, "WxH",
        "Picture size in pixels; default 512 high, as wide as the camera says");
    group.add(
        "--scene", o.scene_of_file, "NAME|INDEX",
        "A scene of the file, by name or index; default the file's default");
    group.add(
        "--camera", o.camera, "NAME|INDEX",
        "A camera of the scene, by its name, its node's or index; default its first");
    group.add(
        "--look-at", o.look_at, "ex,ey,ez,tx,ty,tz", "A camera of your own: eye and target [m]");
    group.add(
        "--fov", o.fov, "DEG", "Vertical field of view; default the camera's, 45 with --look-at");
}

void add_light_options(OptionGroup group, RenderOptions& o) {
    group.add(
        "--env", o.environment, "MAP.hdr|.exr", "Environment map, latitude-longitude .hdr or .exr");
    group.add(
        "--env-radiance", o.environment_radiance, "R,G,B",
        "Constant environment, or the scale of --env");
    group.add(
        "--lumens-per-watt", o.lumens_per_watt, "LM/W",
        "Divides punctual lights; 683 where they are in candela and lux, as in Blender's standard "
        "lighting mode; default 1");
}

void add_sampling_options(OptionGroup group, RenderOptions& o) {
    constexpr int64_t most = 0xFFFFFFFF;
    group.add_number("--spp", o.spp, "N", int64_t{1}, most, "Samples a pixel; default 64");
    group.add("--time", o.time, "SECONDS", "Sample for this long instead [s]");
    group.add(
        "--target-error", o.target_error, "REL",
        "Sample until the mean relative standard error falls below this instead");
    group.add_number("--seed", o.seed, "N", int64_t{0}, most, "Of the random numbers; default 1");
}

void add_method_options(OptionGroup group, RenderOptions& o) {
    std::vector<std::string> names;
    for (const Method& method : methods()) names.push_back(method.name);
    group.add_choice("--method", o.method, names, "The estimator; default mis");
    group.add_choice(
        "--sampler", o.sampler, {"sobol", "independent"}, "Kind of points; default sobol");
    group.add(
        "--termination", o.termination, "HOW",
        "When paths end: zero, depth:D (biased), roulette (default), roulette:q");
    group.add_choice(
        "--light-choice", o.light_choice, {"area", "power"},
        "How lights are chosen; default the method's own");
    group.add_choice(
        "--guide", o.guide, {"on", "off"},
        "Whether mis aims some directions at what lies close to lamps; default on");
    group.add_choice(
        "--layering", o.layering, {"conserving", "specification"},
        "What lies below the specular layer of dielectrics: what that leaves of the energy, or "
        "glTF's letter; default conserving");
    group.add_choice(
        "--distance", o.distance, distance_names(),
        "How stops in media are chosen; default exponential");
    group.add_choice(
        "--direction", o.direction, {"phase", "uniform"}, "Directions in media; default phase");
    group.add(
        "--splits", o.splits, "N,M[,S]",
        "N stops on a segment in a medium, M directions from each, S from a surface point; "
        "default 1,1,1. N > 1 not with --distance exponential");
    group.add_number(
        "--split-depth", o.split_depth, "K", 0, 8,
        "Only the first K vertices and the segments before them branch; default 1");
}

void add_device_options(OptionGroup group, RenderOptions& o) {
    group.add(
        "--device", o.device, "SELECTOR",
        "cpu, gpu, P.D as `wavepath devices` numbers them, or part of a name; default PoCL");
    group.add_number("--pool", o.pool, "SLOTS", 1U, 1U << 24U, "Path slots; default the device's");
    group.add_number(
        "--max-texels", o.max_texels, "MI", 1U, 4096U,
        "Refuse scenes whose images have more Mi texels in all; default 256");
}

}  // namespace

void add_render_options(CLI::App& app, RenderOptions& o) {
    // Not "scene": CLI11 2.4 takes an argument and a flag of one name for the same.
    app.add_option("SCENE", o.scene, "The scene, .gltf or .glb")->required()->type_name("");
    add_view_options({app, "View"}, o);
    add_light_options({app, "Light"}, o);
    add_sampling_options({app, "Samples"}, o);
    add_variant_options(app, o);
}

void add_variant_options(CLI::App& app, RenderOptions& o) {
    add_method_options({app, "Method"}, o);
    add_device_options({app, "Device"}, o);
}

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
