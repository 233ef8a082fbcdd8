#include "scene/extent.h"

#include "error.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavepath {

namespace {

struct Bounds {
    Vec3d low{
        std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::infinity()};
    Vec3d high{
        -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()};

    void extend(const Vec3d& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
};

Bounds world_bounds(const Scene& scene) {
    Bounds bounds;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const uint32_t index : primitive.indices)
            bounds.extend(transform_point(instance.to_world, vec3_at(primitive.positions, index)));
    }
    return bounds;
}

}  // namespace

Extent extent_of(const Scene& scene) {
    const Bounds bounds = world_bounds(scene);
    Extent extent;
    extent.metres = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        extent.centre[k] = 0.5 * (bounds.low[k] + bounds.high[k]);
        extent.metres = std::max(extent.metres, bounds.high[k] - bounds.low[k]);
    }
    if (!std::isfinite(extent.metres) || extent.metres <= 0)
        throw Error(
            "{}: the scene's extent is {} m; give it triangles with an area", scene.name,
            extent.metres);
    return extent;
}

}  // namespace wavepath
