#include "prepare/small_mesh.h"

#include <array>
#include <bit>
#include <cstdint>
#include <map>

namespace wavepath {

std::optional<SmallMesh> small_mesh(const std::vector<float>& positions) {
    const std::size_t triangles = positions.size() / 9;
    if (triangles > SMALL_MESH_TRIANGLES) return std::nullopt;
    SmallMesh mesh{};
    mesh.triangle_count = static_cast<uint32_t>(triangles);
    std::map<std::array<uint32_t, 3>, uint32_t> rows;
    for (std::size_t i = 0; i < 3 * triangles; ++i) {
        std::array<uint32_t, 3> corner{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            corner[axis] = std::bit_cast<uint32_t>(positions[3 * i + axis]);
        const auto [row, added] = rows.try_emplace(corner, mesh.corner_count);
        if (added) {
            if (mesh.corner_count == SMALL_MESH_CORNERS) return std::nullopt;
            for (std::size_t axis = 0; axis < 3; ++axis)
                mesh.corners[axis][mesh.corner_count] = positions[3 * i + axis];
            ++mesh.corner_count;
        }
        mesh.triangles[i / 3][i % 3] = row->second;
    }
    return mesh;
}

}  // namespace wavepath
