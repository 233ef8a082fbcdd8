// Triangle lists, 9 floats a triangle, within 0.5 of the origin: what the BVH is built over and
// rays are shot at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace wavepath {

struct TestMesh {
    std::string name;
    std::vector<float> positions;
    bool closed = false;  // every ray from the origin leaves through a triangle

    std::size_t size() const { return positions.size() / 9; }
};

TestMesh box_mesh();                                     // 12 triangles, closed
TestMesh sphere_mesh(unsigned rings, unsigned sectors);  // closed, slivers at its poles
TestMesh room_mesh();                                    // a box with two boxes in it, axis-aligned
TestMesh height_field_mesh(unsigned cells);              // cells * cells * 2 triangles
TestMesh soup_mesh(std::size_t triangles);               // of all sizes, through one another
TestMesh rods_mesh(unsigned rods);                       // long, thin, in all directions
TestMesh slivers_mesh(std::size_t triangles);            // up to 1 long, down to 1e-6 high

// Every triangle `copies` times: the lowest id of a copy is its index in `mesh`.
TestMesh repeated_mesh(const TestMesh& mesh, unsigned copies);

}  // namespace wavepath
