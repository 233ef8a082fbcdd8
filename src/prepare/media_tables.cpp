#include "prepare/media_tables.h"

#include "error.h"
#include "prepare/device_material.h"
#include "prepare/start_on_face.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace wavepath {

namespace {

constexpr int stack_height = 4;  // of MEDIUM_STACK

// Positions are known to 6e-8 of the scene's extent, and paths end after MAX_SCATTERINGS. Returns
// the warning that a medium is so dense that either is seen (docs/stability.md), or nothing. Throws
// Error where rounding is all that is seen.
std::string warning_of_extinction(const Scene& scene, uint32_t index, double metres) {
    const Material& material = scene.materials[index];
    constexpr double seen = 1e5;  // free paths across the scene
    constexpr double most = 1e6;
    constexpr double long_paths = 1e5;  // [scatterings]
    const Medium& medium = material.medium;
    if (!medium.scatters()) return {};
    double extinction = 0;
    double scatterings = 0;  // to diffuse through the scene, or to be absorbed
    for (std::size_t c = 0; c < 3; ++c) {
        const double sigma_a = medium.sigma_a[c];
        const double sigma_t = sigma_a + medium.sigma_s[c];
        extinction = std::max(extinction, sigma_t);
        const double depth = sigma_t * metres * (1 - std::max(medium.anisotropy, 0.0F));
        scatterings = std::max(
            scatterings, sigma_a > 0 ? std::min(depth * depth, sigma_t / sigma_a) : depth * depth);
    }
    const double free_paths = extinction * metres;
    std::string found = fmt::format(
        "{}: material {} \"{}\": an extinction of {:.3g} per metre makes {:.3g} free paths across "
        "the scene",
        scene.name, index, material.name, extinction, free_paths);
    if (free_paths > most)
        throw Error(
            "{}, more than single precision tells apart ({:.0g}); lower sigma_s and sigma_a", found,
            most);
    if (free_paths > seen) found += ", which single precision renders up to 5 % too dark";
    if (scatterings > long_paths)
        found += fmt::format(
            ", and next to nothing is absorbed: paths may take {:.0g} scatterings, and long to "
            "render; raise sigma_a or lower sigma_s",
            scatterings);
    return free_paths > seen || scatterings > long_paths ? found : "";
}

Vec3d point(const MediaBody::Point& p) {
    return {p[0], p[1], p[2]};
}

Vec3d vertex_of(const MediaBody& body) {
    return point(body.triangles.front().front());
}

// The media that a body's faces bound: rows + 1.
std::set<uint32_t> rows_of(const MediaBody& body, const MediaTables& tables) {
    std::set<uint32_t> rows;
    for (const uint32_t m : body.boundaries) rows.insert(tables.rows[m]);
    return rows;
}

// A body whose faces look inwards ends the medium of one around it: a hollow in glass. Without one,
// the medium that it begins outside would fill the space without bound.
bool is_hollow(
    const MediaBody& body, const std::vector<MediaBody>& bodies, const MediaTables& tables) {
    return std::ranges::any_of(bodies, [&](const MediaBody& other) {
        return &other != &body && rows_of(other, tables) == rows_of(body, tables) &&
               other.winding(vertex_of(body)) > 0.25;  // or touches its surface
    });
}

// Into a body that lies inside too many others light could not be followed.
void check_nesting(
    const Scene& scene, const MediaBody& body, const std::vector<MediaBody>& bodies) {
    double around = 0;  // hollows count -1
    for (const MediaBody& other : bodies)
        if (&other != &body) around += std::round(other.winding(vertex_of(body)));
    if (around < double{stack_height}) return;
    throw Error(
        "{}: {} lies inside {} other media; at most {} may lie around one another", scene.name,
        body.name, around, stack_height);
}

DeviceMedium device_medium(const Scene& scene, uint32_t index, double metres) {
    const Material& material = scene.materials[index];
    const Medium& medium = material.medium;
    const auto scaled = [&](double per_metre) {
        if (per_metre * metres > std::numeric_limits<float>::max())
            throw Error(
                "{}: material {} \"{}\": {:.3g} per metre of its medium, across the scene's {:.3g} "
                "m, is too much for single precision; lower it",
                scene.name, index, material.name, per_metre, metres);
        return static_cast<float>(per_metre * metres);
    };
    DeviceMedium d{};
    d.sigma_s_r = scaled(medium.sigma_s[0]);
    d.sigma_s_g = scaled(medium.sigma_s[1]);
    d.sigma_s_b = scaled(medium.sigma_s[2]);
    d.sigma_t_r = scaled(double{medium.sigma_a[0]} + double{medium.sigma_s[0]});
    d.sigma_t_g = scaled(double{medium.sigma_a[1]} + double{medium.sigma_s[1]});
    d.sigma_t_b = scaled(double{medium.sigma_a[2]} + double{medium.sigma_s[2]});
    d.emission_r = scaled(medium.emission[0]);
    d.emission_g = scaled(medium.emission[1]);
    d.emission_b = scaled(medium.emission[2]);
    d.anisotropy = medium.anisotropy;
    d.ior = material.boundary == Boundary::dielectric ? material.ior : 0;
    return d;
}

// The row + 1 of a medium in the table: materials of equal media share one, so that a ray may enter
// by one of them and leave by another.
uint32_t row_of(const DeviceMedium& medium, std::vector<DeviceMedium>& media) {
    const auto equal = [&](const DeviceMedium& other) {
        using Bits = std::array<uint32_t, sizeof(DeviceMedium) / sizeof(uint32_t)>;
        return std::bit_cast<Bits>(other) == std::bit_cast<Bits>(medium);
    };
    const auto found = std::ranges::find_if(media, equal);
    const auto row = static_cast<uint32_t>(found - media.begin()) + 1;
    if (found == media.end()) media.push_back(medium);
    return row;
}

// Throws Error for bodies that are inside out or stand in too many others; warns of those that a
// ray may enter and never leave.
void check_bodies(const Scene& scene, MediaTables& tables) {
    const std::vector<MediaBody>& bodies = tables.bodies;
    std::vector<std::string> patched;
    std::vector<std::string> open;
    std::vector<std::string> flat;
    for (const MediaBody& body : bodies) {
        if (rows_of(body, tables).size() > 1) patched.push_back(body.name);
        if (!body.closed)
            open.push_back(body.name);
        else if (std::abs(body.volume()) <= 1e-12 * std::pow(coarseness_at(vertex_of(body)), 3))
            flat.push_back(body.name);
        else if (body.volume() < 0 && !is_hollow(body, bodies, tables))
            throw Error(
                "{}: {} is inside out, and no hollow in a body of the same medium; turn its faces",
                scene.name, body.name);
        // a hollow ends a medium
        if (body.volume() > 0 && std::ssize(bodies) > stack_height)
            check_nesting(scene, body, bodies);
    }
    const auto warn = [&](const std::vector<std::string>& names, const char* what) {
        if (names.empty()) return;
        const std::string more =
            names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "";
        tables.warnings.push_back(
            fmt::format("{}: {}{}: {}", scene.name, names.front(), more, what));
    };
    warn(
        patched,
        "the faces bound different media, so a ray may enter one and leave another; give them one "
        "medium");
    warn(
        open,
        "not closed around a medium; rays that leave by a hole leave the medium only when they "
        "leave the scene");
    warn(
        flat,
        "no volume within what bounds a medium; give it thickness, or take KHR_materials_volume "
        "away for a thin wall");
}

}  // namespace

MediaTables build_media_tables(const Scene& scene, const NormalisedScene& geometry) {
    MediaTables tables;
    tables.rows.assign(scene.materials.size(), 0);
    tables.bodies = bodies_with_media(scene, geometry);
    for (const MediaBody& body : tables.bodies)
        for (const uint32_t m : body.boundaries) {
            if (tables.rows[m] > 0) continue;
            const Material& material = scene.materials[m];
            const Medium& medium = material.medium;
            if (auto dense = warning_of_extinction(scene, m, geometry.extent.metres);
                !dense.empty())
                tables.warnings.push_back(std::move(dense));
            tables.rows[m] = row_of(device_medium(scene, m, geometry.extent.metres), tables.media);
            tables.refract = tables.refract || material.boundary == Boundary::dielectric;
            tables.refract_roughly = tables.refract_roughly || refracts_roughly(material);
            tables.scatter = tables.scatter || medium.scatters();
            tables.emit = tables.emit || medium.emits();
        }
    check_bodies(scene, tables);
    constexpr std::size_t most_media = 255;  // eight bits of MEDIUM_STACK
    if (tables.media.size() > most_media)
        throw Error(
            "{}: {} media; at most {} can be told apart: let materials share", scene.name,
            tables.media.size(), most_media);
    return tables;
}

double extinction_around(const Scene& scene, const MediaTables& tables, const Vec3d& point) {
    double largest = 0;
    if (!tables.scatter) return largest;
    for (const MediaBody& body : tables.bodies) {
        if (body.winding(point) < 0.5) continue;
        for (const uint32_t m : body.boundaries) {
            if (!scene.materials[m].medium.scatters()) continue;
            const DeviceMedium& medium = tables.media[tables.rows[m] - 1];
            largest = std::max(
                {largest, double{medium.sigma_t_r}, double{medium.sigma_t_g},
                 double{medium.sigma_t_b}});
        }
    }
    return largest;
}

uint32_t media_at_camera(
    const Scene& scene, const MediaTables& tables, const RenderParams& params) {
    if (tables.media.empty()) return 0;
    const bool orthographic = params.orthographic != 0;
    const Vec3d camera = orthographic ? Vec3d{params.corner_x, params.corner_y, params.corner_z}
                                      : Vec3d{params.camera_x, params.camera_y, params.camera_z};
    std::vector<std::pair<float, uint32_t>> around;  // volume, row + 1
    std::vector<uint32_t> hollow;                    // row + 1
    for (const MediaBody& body : tables.bodies) {
        const auto cuts = [&](const auto& triangle) { return cuts_film(triangle, params); };
        if (orthographic && std::ranges::any_of(body.triangles, cuts))
            throw Error(
                "{}: the plane of the orthographic camera cuts through {}, which encloses a "
                "medium; move the camera back or forth",
                scene.name, body.name);
        const auto touches = [&](const auto& triangle) { return lies_on(triangle, camera); };
        if (!orthographic && std::ranges::any_of(body.triangles, touches))
            throw Error(
                "{}: the camera lies on a face of {}, which encloses a medium: neither inside nor "
                "outside; move it by a millionth of the scene",
                scene.name, body.name);
        const double winding = body.winding(camera);
        for (const uint32_t row : rows_of(body, tables)) {
            for (long k = std::lround(winding); k > 0; --k)  // shells of one mesh may cross
                around.emplace_back(static_cast<float>(body.volume()), row);
            for (long k = std::lround(winding); k < 0; ++k) hollow.push_back(row);
        }
    }
    // of bodies with the same faces the one later in the file stays behind, as for paths
    std::ranges::stable_sort(around, std::greater<>(), &std::pair<float, uint32_t>::first);
    for (const uint32_t row : hollow) {
        const auto innermost = std::find_if(
            around.rbegin(), around.rend(), [&](const auto& a) { return a.second == row; });
        if (innermost != around.rend()) around.erase(std::next(innermost).base());
    }
    if (std::ssize(around) > stack_height)
        throw Error(
            "{}: the camera is inside {} media; at most {} may lie around one another", scene.name,
            around.size(), stack_height);
    uint32_t stack = 0;
    for (const auto& [volume, row] : around) stack = stack << 8U | row;
    return stack;
}

}  // namespace wavepath
