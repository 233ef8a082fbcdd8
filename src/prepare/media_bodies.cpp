#include "prepare/media_bodies.h"

#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace wavepath {

namespace {

using Point = MediaBody::Point;
using Triangle = MediaBody::Triangle;

Vec3d from(const Point& p, const Vec3d& origin) {
    return {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
}

double determinant(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return dot(a, cross(b, c));
}

double length(const Vec3d& a) {
    return std::sqrt(dot(a, a));
}

struct Face {
    Triangle corners;
    uint32_t material;
};

// Numbers for the corners of each face, equal where the corners are one point.
using Corners = std::vector<std::array<uint32_t, 3>>;

class Exact {
  public:
    uint32_t number(const Point& p) {
        return numbers_.emplace(p, static_cast<uint32_t>(numbers_.size())).first->second;
    }

  private:
    std::map<Point, uint32_t> numbers_;
};

// Exporters round a corner differently in each of its triangles: those closer than 2^-21 are one.
// Outside the unit cube they are rounded more: `coarseness` of those about it.
class Welded {
  public:
    explicit Welded(double coarseness) : apart_(0x1p-21 * coarseness) {}

    uint32_t number(const Point& p) {
        const double cells = 0.5 / apart_;
        Cell cell;
        for (std::size_t k = 0; k < 3; ++k) cell[k] = std::lround(cells * p[k]);
        for (long x = -1; x <= 1; ++x)
            for (long y = -1; y <= 1; ++y)
                for (long z = -1; z <= 1; ++z) {
                    const auto found = corners_.find({cell[0] + x, cell[1] + y, cell[2] + z});
                    if (found != corners_.end() && is_near(found->second.first, p))
                        return found->second.second;
                }
        const std::pair corner{p, static_cast<uint32_t>(corners_.size())};
        return corners_.emplace(cell, corner).first->second.second;
    }

  private:
    using Cell = std::array<long, 3>;

    bool is_near(const Point& a, const Point& b) const {
        return std::abs(a[0] - b[0]) < apart_ && std::abs(a[1] - b[1]) < apart_ &&
               std::abs(a[2] - b[2]) < apart_;
    }

    double apart_;
    std::map<Cell, std::pair<Point, uint32_t>> corners_;
};

template <typename Weld>
Corners corners_of(const std::vector<Face>& faces, Weld weld) {
    Corners corners;
    corners.reserve(faces.size());
    for (const Face& face : faces)
        corners.push_back(
            {weld.number(face.corners[0]), weld.number(face.corners[1]),
             weld.number(face.corners[2])});
    return corners;
}

bool are_closed(const Corners& corners) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const auto& corner : corners)
        for (std::size_t k = 0; k < 3; ++k) {
            const uint32_t a = corner[k];
            const uint32_t b = corner[(k + 1) % 3];
            if (a != b) edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

// Of every face a corner that all faces of its piece share: faces with a common corner are of one.
std::vector<uint32_t> pieces_of(const Corners& corners) {
    uint32_t most = 0;
    for (const auto& corner : corners) most = std::max({most, corner[0], corner[1], corner[2]});
    std::vector<uint32_t> parents(most + 1);
    std::iota(parents.begin(), parents.end(), 0U);
    const auto root = [&](uint32_t corner) {
        while (parents[corner] != corner) {
            parents[corner] = parents[parents[corner]];
            corner = parents[corner];
        }
        return corner;
    };
    for (const auto& corner : corners)
        for (const uint32_t other : {corner[1], corner[2]}) {
            const uint32_t a = root(corner[0]);
            const uint32_t b = root(other);
            parents[std::max(a, b)] = std::min(a, b);  // the earlier in the file
        }
    std::vector<uint32_t> pieces;
    pieces.reserve(corners.size());
    for (const auto& corner : corners) pieces.push_back(root(corner[0]));
    return pieces;
}

void add(MediaBody& body, const Face& face, const Scene& scene) {
    body.triangles.push_back(face.corners);
    if (scene.materials[face.material].boundary != Boundary::opaque)
        body.boundaries.insert(face.material);
    for (const Point& p : face.corners)
        for (std::size_t k = 0; k < 3; ++k) {
            body.low[k] = std::min(body.low[k], p[k]);
            body.high[k] = std::max(body.high[k], p[k]);
        }
}

// Corners are told apart as written where that closes all, else those that nearly coincide are one.
Corners best_corners_of(const std::vector<Face>& faces) {
    Corners corners = corners_of(faces, Exact{});
    if (are_closed(corners)) return corners;
    const Point& p = faces.front().corners.front();
    const double coarseness = coarseness_at({p[0], p[1], p[2]});
    return corners_of(faces, Welded(std::exp2(std::floor(std::log2(coarseness)))));
}

struct Piece {
    std::vector<Face> faces;
    bool closed;
};

// In the order of the file.
std::vector<Piece> split(const std::vector<Face>& faces) {
    const Corners corners = best_corners_of(faces);
    const std::vector<uint32_t> piece_of = pieces_of(corners);
    std::map<uint32_t, std::pair<std::vector<Face>, Corners>> pieces;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        auto& [its_faces, its_corners] = pieces[piece_of[i]];
        its_faces.push_back(faces[i]);
        its_corners.push_back(corners[i]);
    }
    std::vector<Piece> in_order;
    in_order.reserve(pieces.size());
    for (auto& [first, piece] : pieces)
        in_order.push_back({std::move(piece.first), are_closed(piece.second)});
    return in_order;
}

// Of the faces of one mesh: the closed boundaries of one material, those of several, and one body
// of the open ones with what else is open.
std::vector<MediaBody> bodies_of(
    const Scene& scene, const std::vector<Face>& faces, const std::string& name) {
    const auto bounds = [&](const Face& face) {
        return scene.materials[face.material].boundary != Boundary::opaque;
    };
    std::vector<MediaBody> bodies;
    const auto new_body = [&]() -> MediaBody& {
        MediaBody& body = bodies.emplace_back();
        body.name = name;
        body.closed = true;
        return body;
    };
    // makes bodies of the closed pieces and returns what is left
    const auto close = [&](const std::vector<Face>& some) {
        std::vector<Face> open;
        for (const Piece& piece : split(some)) {
            if (!piece.closed) {
                open.insert(open.end(), piece.faces.begin(), piece.faces.end());
                continue;
            }
            MediaBody& body = new_body();
            for (const Face& face : piece.faces) add(body, face, scene);
        }
        return open;
    };
    std::vector<Face> opaque;
    std::vector<std::vector<Face>> by_material;  // in the order of the file
    for (const Face& face : faces) {
        if (!bounds(face)) {
            opaque.push_back(face);
            continue;
        }
        const auto its = std::ranges::find_if(
            by_material, [&](const auto& some) { return some[0].material == face.material; });
        if (its == by_material.end())
            by_material.push_back({face});
        else
            its->push_back(face);
    }
    std::vector<Face> open;
    for (const std::vector<Face>& some : by_material)
        std::ranges::move(close(some), std::back_inserter(open));
    open = close(open);
    if (open.empty()) return bodies;
    // mirrors may close the open ones; a closed room does not
    opaque.insert(opaque.end(), open.begin(), open.end());
    MediaBody& rest = new_body();
    for (const Piece& piece : split(opaque)) {
        if (piece.closed && std::ranges::none_of(piece.faces, bounds)) continue;
        rest.closed = rest.closed && piece.closed;
        for (const Face& face : piece.faces) add(rest, face, scene);
    }
    return bodies;
}

}  // namespace

double MediaBody::volume() const {
    const Point& p = triangles.front().front();
    const Vec3d corner{p[0], p[1], p[2]};  // far from the origin a sum of products would cancel
    double sum = 0;
    for (const auto& [a, b, c] : triangles)
        sum += determinant(from(a, corner), from(b, corner), from(c, corner)) / 6;
    return sum;
}

double MediaBody::winding(const Vec3d& point) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (point[k] < low[k] || point[k] > high[k]) return 0;
    double sum = 0;
    for (const auto& [pa, pb, pc] : triangles) {
        const Vec3d a = from(pa, point);
        const Vec3d b = from(pb, point);
        const Vec3d c = from(pc, point);
        const double la = length(a);
        const double lb = length(b);
        const double lc = length(c);
        sum += std::atan2(
            determinant(a, b, c), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

std::vector<MediaBody> bodies_with_media(const Scene& scene, const NormalisedScene& geometry) {
    struct Mesh {
        std::vector<Face> faces;
        std::string name;
    };
    std::set<uint32_t> wanted;
    for (const Instance& instance : scene.instances)
        if (scene.materials[scene.primitives[instance.primitive].material].boundary !=
            Boundary::opaque)
            wanted.insert(instance.body);
    std::map<uint32_t, Mesh> meshes;
    uint32_t first = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const uint32_t end = geometry.ends[i];
        if (wanted.contains(instance.body)) {
            const Primitive& primitive = scene.primitives[instance.primitive];
            Mesh& mesh = meshes[instance.body];
            const bool bounds = scene.materials[primitive.material].boundary != Boundary::opaque;
            if (mesh.name.empty() && bounds) mesh.name = primitive.name;
            for (uint32_t t = first; t < end; ++t) {
                const float* p = &geometry.positions[std::size_t{9} * t];
                mesh.faces.push_back(
                    {{Point{p[0], p[1], p[2]}, Point{p[3], p[4], p[5]}, Point{p[6], p[7], p[8]}},
                     primitive.material});
            }
        }
        first = end;
    }
    std::vector<MediaBody> found;
    for (const auto& [number, mesh] : meshes) {
        if (mesh.faces.empty()) continue;  // flattened: nothing is left
        std::ranges::move(bodies_of(scene, mesh.faces, mesh.name), std::back_inserter(found));
    }
    return found;
}

}  // namespace wavepath
