#include "support/grid.h"

#include "support/statistics.h"

#include <fmt/format.h>

#include <numeric>

namespace wavepath {

namespace {

// Nodes and weights on [-1, 1] [Abramowitz & Stegun 1964, table 25.4].
constexpr std::array<double, 4> gauss_node{
    0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> gauss_weight{
    0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

// Node k of 8 on [0, 1].
double node(std::size_t k) {
    return 0.5 + (k < 4 ? -0.5 * gauss_node[k] : 0.5 * gauss_node[k - 4]);
}

double weight(std::size_t k) {
    return 0.5 * gauss_weight[k % 4];
}

// What is left of 1 may be quadrature error alone.
constexpr double quadrature_error = 2e-5;

template <typename T>
std::vector<T> blocks_of(const Grid& grid, const std::vector<T>& fine) {
    const std::size_t columns = grid.columns / grid.block_columns;
    const std::size_t rows = grid.rows / grid.block_rows;
    std::vector<T> coarse(columns * rows + 1);
    for (std::size_t y = 0; y < grid.rows; ++y)
        for (std::size_t x = 0; x < grid.columns; ++x)
            coarse[y / grid.block_rows * columns + x / grid.block_columns] +=
                fine[y * grid.columns + x];
    coarse.back() = fine.back();
    return coarse;
}

}  // namespace

std::string grid_functions(const Grid& grid) {
    return fmt::format(
        "void grid_count(global uint* out, const float x, const float y) {{\n"
        "    const int inside = x >= 0.0f && x <= 1.0f && y >= 0.0f && y <= 1.0f;\n"
        "    const int column = min((int)(x * {0}.0f), {0} - 1);\n"
        "    const int row = min((int)(y * {1}.0f), {1} - 1);\n"
        "    atomic_inc(out + (inside ? row * {0} + column : {0} * {1}));\n"
        "}}\n",
        grid.columns, grid.rows);
}

std::vector<Point2> grid_nodes(const Grid& grid) {
    std::vector<Point2> nodes;
    nodes.reserve(64 * grid.cells());
    for (std::size_t y = 0; y < grid.rows; ++y)
        for (std::size_t x = 0; x < grid.columns; ++x)
            for (std::size_t j = 0; j < 8; ++j)
                for (std::size_t i = 0; i < 8; ++i)
                    nodes.push_back(
                        {(static_cast<double>(x) + node(i)) / static_cast<double>(grid.columns),
                         (static_cast<double>(y) + node(j)) / static_cast<double>(grid.rows)});
    return nodes;
}

std::vector<double> grid_probabilities(const Grid& grid, const std::vector<double>& densities) {
    std::vector<double> probabilities(grid.cells() + 1);
    const double cell_area = 1 / static_cast<double>(grid.cells());
    for (std::size_t cell = 0; cell < grid.cells(); ++cell)
        for (std::size_t j = 0; j < 8; ++j)
            for (std::size_t i = 0; i < 8; ++i)
                probabilities[cell] +=
                    cell_area * weight(i) * weight(j) * densities[64 * cell + 8 * j + i];
    const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
    EXPECT_LT(sum, 1 + quadrature_error) << "the density integrates to more than 1";
    probabilities.back() = sum < 1 - quadrature_error ? 1 - sum : 0;
    return probabilities;
}

void expect_distribution(
    const Grid& grid,
    const std::vector<uint32_t>& counts,
    const std::vector<double>& probabilities,
    std::size_t comparisons) {
    const double samples = std::accumulate(counts.begin(), counts.end(), 0.0);
    std::vector<double> expected = probabilities;
    for (double& e : expected) e *= samples;
    EXPECT_TRUE(counts_follow(counts, expected, 2 * comparisons)) << "fine grid";
    EXPECT_TRUE(counts_follow(blocks_of(grid, counts), blocks_of(grid, expected), 2 * comparisons))
        << "coarse grid";
}

}  // namespace wavepath
