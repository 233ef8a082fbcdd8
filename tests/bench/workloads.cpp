#include "bench/workloads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace wavepath {
namespace {

using Point = std::array<double, 3>;

Point normalised(const Point& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
}

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

TestRay make_ray(const Point& origin, const Point& direction, float t_max) {
    TestRay ray;
    for (std::size_t k = 0; k < 3; ++k) {
        ray.origin[k] = static_cast<float>(origin[k]);
        ray.direction[k] = static_cast<float>(direction[k]);
    }
    ray.t_max = t_max;
    return ray;
}

// Centre to the origin, longest side to 1, the camera with it.
void normalise(Workload& workload) {
    Point low{1e30, 1e30, 1e30};
    Point high{-1e30, -1e30, -1e30};
    std::vector<float>& p = workload.mesh.positions;
    for (std::size_t i = 0; i < p.size(); ++i) {
        low[i % 3] = std::min(low[i % 3], static_cast<double>(p[i]));
        high[i % 3] = std::max(high[i % 3], static_cast<double>(p[i]));
    }
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, high[k] - low[k]);
    const auto map = [&](double x, std::size_t k) {
        return (x - 0.5 * (low[k] + high[k])) / extent;
    };
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = static_cast<float>(map(p[i], i % 3));
    for (std::size_t k = 0; k < 3; ++k) {
        workload.eye[k] = map(workload.eye[k], k);
        workload.target[k] = map(workload.target[k], k);
    }
}

std::vector<TestRay> camera_rays(const Workload& workload, unsigned size, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform;
    const Point& e = workload.eye;
    const Point& t = workload.target;
    const Point forward = normalised({t[0] - e[0], t[1] - e[1], t[2] - e[2]});
    const Point right = normalised(cross(forward, {0, 1, 0}));
    const Point up = cross(right, forward);
    const double half = std::tan(workload.y_fov * std::numbers::pi / 360);
    std::vector<TestRay> rays;
    for (unsigned pixel = 0; pixel < size * size; ++pixel)
        for (int sample = 0; sample < 2; ++sample) {
            const unsigned column = pixel % size;
            const unsigned row = pixel / size;
            const double x = (2 * (column + uniform(random)) / size - 1) * half;
            const double y = (1 - 2 * (row + uniform(random)) / size) * half;
            Point d{};
            for (std::size_t k = 0; k < 3; ++k) d[k] = forward[k] + x * right[k] + y * up[k];
            rays.push_back(make_ray(e, normalised(d), std::numeric_limits<float>::infinity()));
        }
    return rays;
}

struct Surface {
    Point p{};
    Point n{};  // unit, towards where the ray came from
};

Surface surface_at(const TestMesh& mesh, const TestRay& ray, const TestHit& hit) {
    const float* c = &mesh.positions[9 * static_cast<std::size_t>(hit.primitive)];
    Point e{};
    Point f{};
    Surface s;
    for (std::size_t k = 0; k < 3; ++k) {
        e[k] = static_cast<double>(c[3 + k]) - static_cast<double>(c[k]);
        f[k] = static_cast<double>(c[6 + k]) - static_cast<double>(c[k]);
        s.p[k] = c[k] + hit.u * e[k] + hit.v * f[k];
    }
    s.n = normalised(cross(e, f));
    double facing = 0;
    for (std::size_t k = 0; k < 3; ++k) facing += s.n[k] * ray.direction[k];
    for (std::size_t k = 0; k < 3; ++k) {
        if (facing > 0) s.n[k] = -s.n[k];
        s.p[k] += 1e-6 * s.n[k];
    }
    return s;
}

TestRay diffuse_ray(const Surface& s, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform;
    const double z = 1 - 2 * uniform(random);
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    const double phi = 2 * std::numbers::pi * uniform(random);
    const Point d{s.n[0] + r * std::cos(phi), s.n[1] + r * std::sin(phi), s.n[2] + z};
    return make_ray(s.p, normalised(d), std::numeric_limits<float>::infinity());
}

TestRay lamp_ray(const Surface& s, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-0.15, 0.15);
    const Point lamp{uniform(random), 0.6, uniform(random)};
    return make_ray(s.p, {lamp[0] - s.p[0], lamp[1] - s.p[1], lamp[2] - s.p[2]}, 0.999F);
}

}  // namespace

Workload terrain_workload(unsigned vertices) {
    struct Wave {
        double frequency, amplitude, phase;
    };
    constexpr std::array<Wave, 6> waves{
        {{2, .35, .3},
         {5, .16, 1.1},
         {11, .07, 2.3},
         {29, .03, .7},
         {83, .012, 1.9},
         {211, .005, .2}}};
    std::vector<std::array<float, 3>> grid;
    for (unsigned i = 0; i < vertices * vertices; ++i) {
        const unsigned row = i / vertices;
        const unsigned column = i % vertices;
        const double x = -2 + 4.0 * row / (vertices - 1);
        const double z = -2 + 4.0 * column / (vertices - 1);
        double y = 0;
        for (const Wave& w : waves)
            y += w.amplitude * std::sin(w.frequency * x + w.phase) *
                 std::cos(0.9 * w.frequency * z + 2 * w.phase);
        grid.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    }
    Workload workload{{"terrain", {}, false}, {1.9, 1.5, 2.6}, {0, -0.1, 0}, 45};
    for (unsigned i = 0; i + 1 < vertices; ++i)
        for (unsigned j = 0; j + 1 < vertices; ++j) {
            const unsigned a = i * vertices + j;
            for (const unsigned k : {a, a + 1, a + vertices, a + 1, a + vertices + 1, a + vertices})
                workload.mesh.positions.insert(
                    workload.mesh.positions.end(), grid[k].begin(), grid[k].end());
        }
    normalise(workload);
    return workload;
}

Workload spheres_workload(unsigned spheres, unsigned sectors) {
    const TestMesh sphere = sphere_mesh(sectors + 1, sectors);
    Workload workload{{"spheres", {}, false}, {0, 0, 3.2}, {0, 0, 0}, 45};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform;
    for (unsigned i = 0; i < spheres; ++i) {
        const float u = uniform(random);
        const float diameter =
            4 * (0.03F + 0.09F * u * u) * std::cbrt(200.0F / static_cast<float>(spheres));
        const std::array<float, 3> centre{
            2 * uniform(random) - 1, 2 * uniform(random) - 1, 2 * uniform(random) - 1};
        for (std::size_t k = 0; k < sphere.positions.size(); ++k)
            workload.mesh.positions.push_back(centre[k % 3] + diameter * sphere.positions[k]);
    }
    normalise(workload);
    return workload;
}

std::vector<RaySet> make_ray_sets(
    const Workload& workload, unsigned size, const ClosestHits& closest_hits) {
    std::mt19937 random(1);
    std::vector<RaySet> sets{
        {"camera", false, camera_rays(workload, size, random)},
        {"bounce 2", false, {}},
        {"bounce 3", false, {}},
        {"shadow 1", true, {}},
        {"shadow 2", true, {}}};
    std::vector<TestRay> rays = sets[0].rays;
    for (std::size_t bounce = 1; bounce <= 3; ++bounce) {
        const std::vector<TestHit> hits = closest_hits(rays);
        std::vector<TestRay> next;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits[i].primitive < 0) continue;
            const Surface surface = surface_at(workload.mesh, rays[i], hits[i]);
            next.push_back(diffuse_ray(surface, random));
            if (bounce < 3) sets[2 + bounce].rays.push_back(lamp_ray(surface, random));
        }
        rays = std::move(next);
        if (bounce > 1) sets[bounce - 1].rays = rays;
    }
    return sets;
}

}  // namespace wavepath
