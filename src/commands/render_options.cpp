#include "commands/render_options.h"

#include "wavefront/method.h"

#include <CLI/CLI.hpp>

namespace wavepath {

namespace {

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

}  // namespace wavepath
