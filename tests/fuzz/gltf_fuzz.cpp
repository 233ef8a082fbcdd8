// Loads glTF files it has broken at random, until the time is over or one of them does harm.
//
//     gltf_fuzz ASSETS SECONDS [SEED]
//
// Every file must load, or be refused in one line that ends in what to do. Anything else, another
// exception, a crash, a sanitizer's report or 20 s of work without an answer, leaves the file in
// ./gltf_fuzz_case and ends the program. Build it with the preset `asan`.
#include "breaking.h"
#include "error.h"
#include "gltf/gltf_loader.h"
#include "prepare/prepared_scene.h"
#include "scene/camera.h"

#include <fmt/format.h>
#include <sys/time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace wavepath {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_seed = 1U << 20U;  // [byte] larger ones only cost time
constexpr std::size_t most_triangles = 1U << 18U;   // beyond, a scene is loaded but not normalised

std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool is_gltf(const fs::path& path) {
    return path.extension() == ".gltf" || path.extension() == ".glb";
}

// A scene file and what it needs from its folder.
struct Seed {
    fs::path file;
    std::vector<fs::path> data;  // .bin files beside it
};

std::vector<Seed> find_seeds(const fs::path& assets) {
    std::vector<Seed> seeds;
    for (const auto& entry : fs::recursive_directory_iterator(assets)) {
        if (!is_gltf(entry.path()) || entry.file_size() > largest_seed) continue;
        Seed seed{entry.path(), {}};
        std::uintmax_t size = 0;
        for (const auto& beside : fs::directory_iterator(entry.path().parent_path()))
            if (beside.path().extension() == ".bin") {
                seed.data.push_back(beside.path());
                size += beside.file_size();
            }
        if (size <= largest_seed) seeds.push_back(std::move(seed));
    }
    std::ranges::sort(seeds, {}, &Seed::file);
    return seeds;
}

// Writes the seed, broken, into `folder`; returns the scene's path.
fs::path write_broken(const Seed& seed, const fs::path& folder, Random& random) {
    fs::remove_all(folder);
    fs::create_directory(folder);
    std::string bytes = read(seed.file);
    const bool breaks_data = !seed.data.empty() && below(random, 4) == 0;
    if (!breaks_data && below(random, 3) == 0)
        break_bytes(bytes, random);
    else if (!breaks_data)
        break_json_of(bytes, random);
    for (const fs::path& path : seed.data) {
        std::string data = read(path);
        if (breaks_data) break_bytes(data, random);
        std::ofstream(folder / path.filename(), std::ios::binary) << data;
    }
    fs::path scene = folder / seed.file.filename();
    std::ofstream(scene, std::ios::binary) << bytes;
    return scene;
}

struct Tally {
    std::size_t loaded = 0;
    std::size_t refused = 0;
};

// What rendering builds before it needs a device. Throws what is a finding.
void check_prepared(const Scene& scene) {
    Preparation preparation;
    preparation.lights_alone = true;
    preparation.aims = true;
    preparation.page_bytes = 1U << 30U;
    const PreparedScene prepared = prepare(scene, choose_camera(scene, ""), preparation);
    const NormalisedScene& geometry = prepared.geometry();
    for (const float x : geometry.positions)
        if (!geometry.is_far() && !(std::abs(x) <= 0.501F))
            throw std::logic_error("a corner is out of bounds");
    for (const float x : geometry.normals)
        if (!std::isfinite(x)) throw std::logic_error("a normal is not finite");
    for (const DeviceLight& light : prepared.lights.lights)
        if (!(light.pmf >= 0)) throw std::logic_error("the chance of a light is not a number");
}

// Throws what is a finding.
void load(const fs::path& path, Tally& tally) {
    try {
        const Scene scene = load_gltf(path);
        if (scene.triangle_count() <= most_triangles) check_prepared(scene);
        ++tally.loaded;
    } catch (const Error& error) {
        const std::string_view message = error.what();
        if (message.find('\n') != message.npos || message.find(';') == message.npos ||
            message.size() > 1000)
            throw std::logic_error(fmt::format("no clear line: {}", message));
        ++tally.refused;
    }
}

int fuzz(const fs::path& assets, double seconds, std::uint32_t number) {
    const std::vector<Seed> seeds = find_seeds(assets);
    const fs::path folder = fs::current_path() / "gltf_fuzz_case";
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    Tally tally;
    std::uint32_t iteration = 0;
    for (; elapsed() < seconds && !seeds.empty(); ++iteration) {
        Random random(number * 1000003U + iteration);
        const Seed& seed = seeds[below(random, seeds.size())];
        const fs::path scene = write_broken(seed, folder, random);
        const itimerval limit{{0, 0}, {20, 0}};  // of the processor's time, then SIGPROF ends it
        setitimer(ITIMER_PROF, &limit, nullptr);
        try {
            load(scene, tally);
        } catch (const std::exception& exception) {
            fmt::print("{}: {}\n", scene.string(), exception.what());
            return 1;
        }
    }
    fs::remove_all(folder);
    fmt::print(
        "{} seeds, {} broken files in {:.0f} s: {} loaded, {} refused\n", seeds.size(), iteration,
        elapsed(), tally.loaded, tally.refused);
    return 0;
}

}  // namespace
}  // namespace wavepath

int main(int argc, char** argv) {
    if (argc < 3 || argc > 4) {
        fmt::print("usage: gltf_fuzz ASSETS SECONDS [SEED]\n");
        return 2;
    }
    try {
        return wavepath::fuzz(
            argv[1], std::stod(argv[2]),
            argc == 4 ? static_cast<std::uint32_t>(std::stoul(argv[3])) : 1);
    } catch (const std::exception& exception) {  // of the arguments or the file system
        std::puts(exception.what());
        return 2;
    }
}
