// The bodies that enclose media: which triangles bound one together.
#pragma once

#include "prepare/normalise.h"
#include "scene/scene.h"

#include <array>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace wavepath {

struct MediaBody {
    using Point = std::array<float, 3>;  // [normalised]
    using Triangle = std::array<Point, 3>;

    std::vector<Triangle> triangles;
    std::set<uint32_t> boundaries;  // materials of the triangles that let light in
    std::string name;               // of its primitive
    bool closed = false;            // every edge is run through as often one way as the other
    Point low{inf, inf, inf};       // of its bounding box
    Point high{-inf, -inf, -inf};

    double volume() const;  // below 0: its faces look inwards

    // Around a point: how often the body is around it; no integer where its mesh is open
    // [Van Oosterom & Strackee 1983; Jacobson 2013].
    double winding(const Vec3d& point) const;

  private:
    static constexpr float inf = std::numeric_limits<float>::infinity();
};

// Every closed piece of a mesh's boundaries is a body: of one material, else of several. The others
// of the mesh are one, with all its triangles that are not closed by themselves: mirrors may close
// it. A mesh that two nodes place is two.
std::vector<MediaBody> bodies_with_media(const Scene& scene, const NormalisedScene& geometry);

}  // namespace wavepath
