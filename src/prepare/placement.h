#pragma once

#include "prepare/bvh_builder.h"
#include "prepare/normalise.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace wavepath {

struct PlacedScene {
    NormalisedScene geometry;
    Bvh bvh;
    double free_distance = 0;  // from an eye that is far off to what it sees [normalised]
    std::vector<std::string> warnings;
};

// Normalises the scene for an image of `width` x `height` pixels and builds its tree. Floats are
// finest around the origin, so that is where what the camera sees belongs: where this is much
// smaller than the bounding box (a stray vertex, a backdrop, a ground of 100 km), the unit cube is
// laid about it. Throws what normalise throws.
PlacedScene place(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height);

// The cube to normalise about: what this image shows nearest and finest, or nothing where `placed`
// suits it already.
std::optional<Extent> subject_of(
    const PlacedScene& placed, const Camera& camera, uint32_t width, uint32_t height);

}  // namespace wavepath
