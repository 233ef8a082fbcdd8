#include "commands/render_command.h"

#include "commands/shell_word.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

namespace wavepath {

namespace {

using nlohmann::json;

// Numbers of an array, by commas.
std::string list_of(const json& values) {
    std::vector<std::string> words;
    for (const json& value : values) words.push_back(value.dump());
    return fmt::format("{}", fmt::join(words, ","));
}

std::string view_options(const json& settings) {
    std::string text;
    const auto camera = settings.at("camera").get<std::string>();
    const auto to_world = settings.at("camera_to_world").get<std::array<double, 16>>();
    if (camera == "look-at") {  // along the camera's -z
        text += " --look-at ";
        for (std::size_t k = 12; k < 15; ++k) text += fmt::format("{},", to_world[k]);
        for (std::size_t k = 12; k < 15; ++k)
            text += fmt::format("{}{}", to_world[k] - to_world[k - 4], k < 14 ? "," : "");
    } else if (camera != "overview") {
        text += " --camera " + shell_word(camera);
    }
    if (!settings.at("y_fov_deg").is_null() && camera != "overview")
        text += " --fov " + settings.at("y_fov_deg").dump();
    return text;
}

std::string light_options(const json& settings) {
    std::string text;
    const json& environment = settings.at("environment");
    if (!environment.is_null()) {
        const auto map = environment.at("map").get<std::string>();
        if (!map.empty()) text += " --env " + shell_word(map);
        text += " --env-radiance " + list_of(environment.at("radiance"));
    }
    if (settings.at("lumens_per_watt") != 1)
        text += " --lumens-per-watt " + settings.at("lumens_per_watt").dump();
    return text;
}

std::string option_words(const json& settings) {
    std::string text;
    const std::map<std::string, std::string> words{
        {"method", "--method"},           {"light_choice", "--light-choice"},
        {"termination", "--termination"}, {"sampler", "--sampler"},
        {"layering", "--layering"},       {"distance", "--distance"},
        {"direction", "--direction"},     {"scene_of_file", "--scene"}};
    for (const auto& [key, option] : words) {
        const std::string value = settings.value(key, "");
        if (!value.empty()) text += " " + option + " " + shell_word(value);
    }
    if (!settings.at("guide").get<bool>()) text += " --guide off";
    if (settings.at("splits") != json{1, 1, 1})
        text += fmt::format(
            " --splits {} --split-depth {}", list_of(settings.at("splits")),
            settings.at("split_depth").dump());
    return text;
}

}  // namespace

std::string render_command(const Image& image) {
    try {
        const json settings = json::parse(image.metadata.at("wavepath.settings"));
        return fmt::format(
            "wavepath render {} --size {}x{} --spp {} --seed {}{}{}{}",
            shell_word(image.metadata.at("wavepath.scene")), image.width, image.height,
            image.metadata.at("wavepath.samples"), settings.at("seed").dump(),
            view_options(settings), light_options(settings), option_words(settings));
    } catch (const std::exception&) {  // another program's, or an older one's
        return "";
    }
}

bool are_exchangeable(const Image& a, const Image& b) {
    const auto of = [](const Image& image) {
        std::map<std::string, std::string> rest = image.metadata;
        for (const char* key : {"wavepath.seed", "wavepath.device", "wavepath.driver"})
            rest.erase(key);
        json settings = json::parse(rest["wavepath.settings"], nullptr, false);
        if (settings.is_object()) settings.erase("seed");
        rest["wavepath.settings"] = settings.dump();
        return rest;
    };
    return a.metadata.contains("wavepath.settings") && of(a) == of(b);
}

}  // namespace wavepath
