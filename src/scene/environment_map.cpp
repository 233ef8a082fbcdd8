#include "scene/environment_map.h"

#include "error.h"
#include "image/exr_writer.h"

#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC  // libtinygltf brings another copy
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#include <stb_image.h>

namespace wavepath {
namespace {

// stb_image takes the end of a file for zeros, and version 2.27 loops for ever over runs of length
// zero. Past the end this source hands out line feeds, which end a header and are a valid length of
// a run, and remembers that it had to.
struct Source {
    std::ifstream stream;
    bool exhausted = false;

    static int read(void* source, char* data, int size) {
        auto& [stream, exhausted] = *static_cast<Source*>(source);
        stream.read(data, size);
        const int count = static_cast<int>(stream.gcount());
        // Requests of at most a texel are for bytes needed now; larger ones refill a buffer and may
        // end early.
        if (count == size || (count > 0 && size > 4)) return count;
        exhausted = true;
        std::fill(data + count, data + size, '\n');
        return size;
    }
    static void skip(void* source, int count) {
        static_cast<Source*>(source)->stream.ignore(count);
    }
    static int at_end(void* source) { return static_cast<Source*>(source)->exhausted; }
};

Environment load_radiance(const std::string& path) {
    Source source{std::ifstream(path, std::ios::binary)};
    source.stream.peek();  // a folder opens, but does not read
    if (!source.stream)
        throw Error("{}: cannot be read: {}; check the name", path, std::strerror(errno));

    constexpr stbi_io_callbacks callbacks{Source::read, Source::skip, Source::at_end};
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<float, void (*)(void*)> texels(
        stbi_loadf_from_callbacks(&callbacks, &source, &width, &height, &channels, 3),
        stbi_image_free);
    if (source.exhausted) throw Error("{}: is empty or cut off; copy or download it again", path);
    if (!texels) {
        throw Error(
            "{}: is no Radiance .hdr or OpenEXR image that can be read ({}); convert it by "
            "oiiotool",
            path, stbi_failure_reason());
    }

    Environment map;
    map.width = static_cast<uint32_t>(width);
    map.height = static_cast<uint32_t>(height);
    map.pixels.assign(texels.get(), texels.get() + 3 * std::size_t{map.width} * map.height);
    return map;
}

Environment load_exr(const std::string& path) {
    const Image image = read_exr(path);
    const auto plane = [&](const char* name) {
        const auto entry = image.channels.find(name);
        return entry == image.channels.end() ? nullptr : &entry->second;
    };
    std::array planes{plane("R"), plane("G"), plane("B")};
    if (!planes[0] && !planes[1] && !planes[2]) planes.fill(plane("Y"));
    if (!planes[0] || !planes[1] || !planes[2]) {
        throw Error("{}: has neither channels R, G, B nor Y; rename its channels", path);
    }

    Environment map;
    map.width = image.width;
    map.height = image.height;
    map.pixels.reserve(3 * planes[0]->size());
    for (std::size_t texel = 0; texel < planes[0]->size(); ++texel) {
        for (const auto* channel : planes) map.pixels.push_back((*channel)[texel]);
    }
    return map;
}

}  // namespace

Environment load_environment_map(const std::filesystem::path& path) {
    const std::string name = path.string();
    Environment map = Imf::isOpenExrFile(name.c_str()) ? load_exr(name) : load_radiance(name);
    if (map.pixels.empty()) throw Error("{}: holds no pixels; choose another map", name);
    const auto bad = std::find_if(map.pixels.begin(), map.pixels.end(), [](float radiance) {
        return !(radiance >= 0.0f && std::isfinite(radiance));
    });
    if (bad != map.pixels.end()) {
        const auto texel = static_cast<std::size_t>(bad - map.pixels.begin()) / 3;
        throw Error(
            "{}: texel ({}, {}) holds {}; repair it by oiiotool --fixnan box3 --clamp:min=0", name,
            texel % map.width, texel / map.width, *bad);
    }
    map.name = name;
    map.radiance = {1, 1, 1};
    return map;
}

}  // namespace wavepath
