#include "measure/pixels.h"

#include "error.h"

#include <utility>

namespace wavepath {

void check_comparable(
    const Image& a, const std::string& name_a, const Image& b, const std::string& name_b) {
    for (const auto& [image, name] : {std::pair{&a, &name_a}, std::pair{&b, &name_b}})
        for (const char* channel : {"R", "G", "B"})
            if (!image->channels.contains(channel))
                throw Error("{}: has no channel {}; use a picture with R, G and B", *name, channel);
    if (a.width != b.width || a.height != b.height)
        throw Error(
            "{} has {} x {} pixels and {} has {} x {}; render both with one --size", name_a,
            a.width, a.height, name_b, b.width, b.height);
}

}  // namespace wavepath
