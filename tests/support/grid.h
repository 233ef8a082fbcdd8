// Histograms of a sampler over the unit square, against its density.
#pragma once

#include "support/probe.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wavepath {

// A fine grid for local holes and a coarse one, of blocks of its cells, for small tilts. With N
// samples and 120 coarse cells a density that is off by +-b over halves of the domain is found with
// probability .99 at level 1e-8 once N b^2 >= 175; 5760 fine cells find it only once N b^2 >= 830.
struct Grid {
    std::size_t columns = 60;
    std::size_t rows = 96;
    std::size_t block_columns = 6;
    std::size_t block_rows = 8;

    std::size_t cells() const { return columns * rows; }
};

// OpenCL C: `grid_count(out, x, y)` counts a point of the unit square in its cell, any other in the
// cell behind the last.
std::string grid_functions(const Grid& grid);

using Point2 = std::array<double, 2>;

// Nodes of a Gauss-Legendre rule of 8 x 8 points in every cell, cell by cell.
std::vector<Point2> grid_nodes(const Grid& grid);

// From the density (per unit of area of the square) at those nodes: the chance of each cell, and of
// the outside.
std::vector<double> grid_probabilities(const Grid& grid, const std::vector<double>& densities);

// Both chi-square tests of `counts` (grid.cells() + 1 of them), out of `comparisons` such pairs.
void expect_distribution(
    const Grid& grid,
    const std::vector<uint32_t>& counts,
    const std::vector<double>& probabilities,
    std::size_t comparisons);

}  // namespace wavepath
