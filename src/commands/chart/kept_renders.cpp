#include "commands/chart/kept_renders.h"

#include "commands/interrupt.h"
#include "commands/json_text.h"
#include "commands/report.h"
#include "error.h"
#include "image/exr_writer.h"

#include <spdlog/spdlog.h>

#include <cctype>
#include <charconv>
#include <functional>
#include <set>

namespace wavepath {

namespace {

constexpr const char* key_name = "wavepath.chart.key";

// FNV-1a, 64 bits.
uint64_t hash_of(const std::string& text) {
    uint64_t hash = 0xCBF29CE484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
    return hash;
}

// All that decides the picture and its time. Of the scene's files their sizes and times of change
// stand for what is in them.
std::string key_of(
    const RenderJob& job, const std::vector<std::filesystem::path>& files, const Device& device) {
    nlohmann::ordered_json key = settings_report(job);
    key["program"] = build_text();
    key["device"] = {device.info.platform, device.info.name, device.info.driver};
    for (const auto& file : files) {
        std::error_code ignored;
        key["files"].push_back(
            {file.string(), std::filesystem::file_size(file, ignored),
             std::filesystem::last_write_time(file, ignored).time_since_epoch().count()});
    }
    return json_text(key, -1);
}

std::filesystem::path name_of_render(
    const std::string& label, uint64_t samples, uint32_t seed, const std::string& key) {
    std::string name;
    for (const char c : label) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return fmt::format("{}.{}.{}.{:016x}.exr", name, samples, seed, hash_of(key));
}

double number_of(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::optional<KeptRender> load(const std::filesystem::path& path, const std::string& key) {
    if (!std::filesystem::exists(path)) return std::nullopt;
    try {
        KeptRender kept;
        kept.image = read_exr(path);
        auto& metadata = kept.image.metadata;
        if (metadata[key_name] != key) return std::nullopt;
        kept.seconds = number_of(metadata["wavepath.chart.seconds"]);
        kept.bias = metadata["wavepath.bias"];
        kept.nonfinite_samples =
            static_cast<uint64_t>(number_of(metadata["wavepath.chart.nonfinite_samples"]));
        return kept;
    } catch (const Error& error) {
        spdlog::warn("{}; it is rendered again", error.what());
        return std::nullopt;
    }
}

}  // namespace

Devices open_devices(const std::vector<Variant>& variants, const std::string& more) {
    std::set<std::string, std::greater<>> selectors{more};  // "" is the last
    for (const Variant& variant : variants) selectors.insert(variant.device);
    Devices devices;
    for (const std::string& selector : selectors) devices.emplace(selector, open_device(selector));
    return devices;
}

KeptRenders::KeptRenders(
    std::filesystem::path folder,
    const RenderJob& job,
    std::vector<std::filesystem::path> files,
    const Devices& devices)
    : folder_(std::move(folder)), job_(job), files_(std::move(files)), devices_(devices) {
    std::error_code failure;
    std::filesystem::create_directories(folder_, failure);
    if (failure) throw Error("{}: {}; name another folder", folder_.string(), failure.message());
}

KeptRender KeptRenders::get(
    const Variant& variant, uint64_t samples, uint32_t seed, const std::function<bool()>& stop) {
    const Device& on = devices_.at(variant.device);
    job_.settings = variant.settings;
    job_.settings.samples = samples;
    job_.settings.seconds = 0;
    job_.settings.seed = seed;
    const std::string key = key_of(job_, files_, on);
    const std::filesystem::path path = folder_ / name_of_render(variant.label, samples, seed, key);
    if (auto kept = load(path, key)) {
        ++found_;
        return *std::move(kept);
    }
    if (stop()) throw Interrupted{interrupt_signal()};
    const RenderResult result = render(on, job_.scene, job_.settings, {}, stop);
    if (result.interrupted) throw Interrupted{interrupt_signal()};
    ++rendered_;
    KeptRender kept;
    kept.image.width = result.film.image.width;
    kept.image.height = result.film.image.height;
    for (const char* channel : {"R", "G", "B"})
        kept.image.channels[channel] = result.film.image.channels.at(channel);
    kept.seconds = result.times.render;
    kept.bias = bias_of(job_.settings, result);
    kept.nonfinite_samples = result.film.nonfinite.samples;
    kept.image.metadata = {
        {key_name, key},
        {"wavepath.scene", job_.scene.name},
        {"wavepath.samples", std::to_string(samples)},
        {"wavepath.settings", json_text(settings_report(job_), -1)},
        {"wavepath.bias", kept.bias},
        {"wavepath.chart.seconds", fmt::format("{}", kept.seconds)},
        {"wavepath.chart.nonfinite_samples", std::to_string(kept.nonfinite_samples)}};
    write_exr(kept.image, path);
    return kept;
}

}  // namespace wavepath
