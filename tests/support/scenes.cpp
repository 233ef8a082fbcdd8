#include "support/scenes.h"

#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace wavepath {

namespace {

struct UnitIcosphere {
    std::vector<Vec3d> corners;
    std::vector<std::array<uint32_t, 3>> faces;

    explicit UnitIcosphere(int subdivisions) {
        const double t = std::numbers::phi;
        corners = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                   {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
        for (Vec3d& c : corners) c = normalized(c);
        faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
        for (int level = 0; level < subdivisions; ++level) subdivide();
    }

    double volume() const {
        double sum = 0;
        for (const auto& f : faces)
            sum += dot(corners[f[0]], cross(corners[f[1]], corners[f[2]])) / 6;
        return sum;
    }

  private:
    void subdivide() {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [at, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(corners.size()));
            if (is_new) corners.push_back(normalized(plus(corners[a], corners[b])));
            return at->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const uint32_t ab = middle(a, b);
            const uint32_t bc = middle(b, c);
            const uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
};

}  // namespace

Material dielectric(const Rgb& base_color, float roughness) {
    Material m = metal(base_color, roughness);
    m.metallic = 0;
    return m;
}

Primitive& add_icosphere(
    Scene& scene,
    const Material& material,
    const Vec3d& centre,
    double radius,
    int subdivisions,
    Facing facing) {
    const UnitIcosphere sphere(subdivisions);
    const double scale = radius * std::cbrt(4 * std::numbers::pi / 3 / sphere.volume());
    std::vector<float> positions;
    for (const Vec3d& c : sphere.corners)
        for (const double x : plus(centre, times(c, scale)))
            positions.push_back(static_cast<float>(x));
    std::vector<uint32_t> indices;
    for (const auto& [a, b, c] : sphere.faces)
        indices.insert(
            indices.end(),
            {a, facing == Facing::outward ? b : c, facing == Facing::outward ? c : b});
    return add_triangles(scene, material, std::move(positions), std::move(indices));
}

void split_off(Scene& scene, std::size_t first_index, const Material& material) {
    Primitive& whole = scene.primitives.back();
    const auto first = whole.indices.begin() + static_cast<std::ptrdiff_t>(first_index);
    std::vector<float> corners = whole.positions;
    std::vector<uint32_t> rest(first, whole.indices.end());
    whole.indices.erase(first, whole.indices.end());
    const uint32_t body = scene.instances.back().body;
    add_triangles(scene, material, std::move(corners), std::move(rest));
    scene.instances.back().body = body;
}

double icosphere_sagitta(int subdivisions) {
    // the largest faces of an icosahedron's subdivision have a circumradius of 0.65 /
    // 2^subdivisions
    const double circumradius = 0.65 / std::exp2(subdivisions);
    return 1 - std::sqrt(1 - circumradius * circumradius);
}

}  // namespace wavepath
