// What the traversal benchmark traces: scenes of 10^5 and 10^6 triangles, and the rays of a path
// tracer in them.
#pragma once

#include "support/meshes.h"
#include "support/ray_oracle.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace wavepath {

struct Workload {
    TestMesh mesh;
    std::array<double, 3> eye{};
    std::array<double, 3> target{};
    double y_fov = 0;  // [degrees]
};

struct RaySet {
    std::string name;
    bool shadow = false;  // any hit before t_max; else the closest hit
    std::vector<TestRay> rays;
};

Workload terrain_workload(unsigned vertices);  // a side; scenes/terrain has 707
Workload spheres_workload(
    unsigned spheres, unsigned sectors);  // overlapping, 2 * sectors^2 triangles each

using ClosestHits = std::function<std::vector<TestHit>(const std::vector<TestRay>&)>;

// Camera rays in pixel order, size * size * 2 of them; the second and third bounce of diffuse paths
// from there, what left the scene dropped; and connections from the first and second hit to points
// on a lamp above.
std::vector<RaySet> make_ray_sets(
    const Workload& workload, unsigned size, const ClosestHits& closest_hits);

}  // namespace wavepath
