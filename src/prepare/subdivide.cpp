#include "prepare/subdivide.h"

#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace wavepath {
namespace {

// Of edges that stay whole wherever they are: the diagonal of the unit cube and some rounding.
constexpr double longest_near = 1.75;

Vec3d middle(const Vec3d& a, const Vec3d& b) {
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

// Squared distance of the segment from the origin. The same bits from either end.
double squared_distance(Vec3d a, Vec3d b) {
    if (b < a) std::swap(a, b);
    const Vec3d along = minus(b, a);
    const double t = std::clamp(-dot(a, along) / dot(along, along), 0.0, 1.0);
    const Vec3d nearest{a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]};
    return dot(nearest, nearest);
}

// The longest edge that is too long, by the corner that it starts at.
std::optional<std::size_t> edge_to_cut(const Piece& piece) {
    std::optional<std::size_t> found;
    double longest = longest_near * longest_near;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d& a = piece[k].position;
        const Vec3d& b = piece[(k + 1) % 3].position;
        const Vec3d along = minus(b, a);
        const double length2 = dot(along, along);
        if (!(length2 > longest) || !(length2 > 4 * squared_distance(a, b))) continue;
        longest = length2;
        found = k;
    }
    return found;
}

}  // namespace

Piece whole(const std::array<Vec3d, 3>& corners) {
    return {{{corners[0], {1, 0, 0}}, {corners[1], {0, 1, 0}}, {corners[2], {0, 0, 1}}}};
}

std::vector<Piece> pieces_of(const std::array<Vec3d, 3>& corners) {
    std::vector<Piece> pieces;
    std::vector<Piece> waiting{whole(corners)};
    while (!waiting.empty()) {
        const Piece piece = waiting.back();
        waiting.pop_back();
        const std::optional<std::size_t> cut = edge_to_cut(piece);
        if (!cut) {
            pieces.push_back(piece);
            continue;
        }
        const std::size_t next = (*cut + 1) % 3;
        const PieceCorner half{
            middle(piece[*cut].position, piece[next].position),
            middle(piece[*cut].weights, piece[next].weights)};
        Piece first = piece;
        Piece second = piece;
        first[next] = half;
        second[*cut] = half;
        waiting.push_back(second);
        waiting.push_back(first);
    }
    return pieces;
}

}  // namespace wavepath
