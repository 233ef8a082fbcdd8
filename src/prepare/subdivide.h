// Triangles that are large beside their distance from the origin, cut up.
#pragma once

#include "scene/scene.h"

#include <array>
#include <vector>

namespace wavepath {

struct PieceCorner {
    Vec3d position;  // [normalised]
    Vec3d weights;   // barycentric, of the corners of the triangle that the piece is of
};
using Piece = std::array<PieceCorner, 3>;

Piece whole(const std::array<Vec3d, 3>& corners);

// Cuts a triangle at the middles of its edges until none is longer than those in the unit cube, or
// than twice its distance from the origin: rounding of hits, which grows with the triangle, then
// stays below the offset of rays, which grows with that distance. The pieces turn as the triangle
// does. An edge is cut by what it is, whatever triangle it belongs to, so that closed meshes stay
// closed. A ground of 10^6 around the origin becomes some 10^3 pieces.
std::vector<Piece> pieces_of(const std::array<Vec3d, 3>& corners);

}  // namespace wavepath
