#include "measure/expectation.h"

#include "measure/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace wavepath {

namespace {

constexpr std::size_t smallest_tile = 8;  // pixels a side, so that 64 bits are a tile's signs
constexpr double least_pixels = 32;       // that carry the differences of a tile
constexpr double rounding = 4e-6;         // relative
constexpr std::size_t enough_above = 100;
constexpr std::size_t most_flips = 9999;

using Components = std::array<double, 4>;  // R, G, B and their sum

struct Tile {
    Components scale{};  // 1 / sqrt(sum d^2); 0: does not count
    std::size_t parent = 0;
};

// Tiles of one size, and how many of them count.
struct Level {
    std::vector<Tile> tiles;
    std::array<std::size_t, 4> count{};
};

double log_tail(double z) {  // of the normal distribution, P(Z > z)
    const double x = z / std::numbers::sqrt2;
    return x < 20 ? std::log(0.5 * std::erfc(x))
                  : -x * x - std::log(2 * x * std::sqrt(std::numbers::pi));
}

// log P(chi-square of n degrees > q) by [Wilson & Hilferty 1931].
double log_chi_square_tail(double q, double n) {
    const double variance = 2 / (9 * n);
    return log_tail((std::cbrt(q / n) - (1 - variance)) / std::sqrt(variance));
}

// Sums over the pixels of a tile.
struct Powers {
    Components squares{}, fourths{};

    void add(const Powers& other) {
        for (std::size_t c = 0; c < 4; ++c) {
            squares[c] += other.squares[c];
            fourths[c] += other.fourths[c];
        }
    }
};

// What `powers` are of, with scales where the differences of a component come from enough pixels
// on average over the tiles: (sum d^2)^2 / sum d^4 is the number of those. `some`: any will do.
Level level_of(const std::vector<Powers>& powers, bool some) {
    Level level{.tiles = std::vector<Tile>(powers.size())};
    for (std::size_t c = 0; c < 4; ++c) {
        std::size_t count = 0;
        double inverse = 0;
        for (const Powers& tile : powers) {
            if (!(tile.squares[c] > 0)) continue;
            ++count;
            inverse += tile.fourths[c] / (tile.squares[c] * tile.squares[c]);
        }
        if (!some && inverse * least_pixels > static_cast<double>(count)) continue;
        level.count[c] = count;
        for (std::size_t i = 0; i < powers.size(); ++i)
            if (powers[i].squares[c] > 0)
                level.tiles[i].scale[c] = 1 / std::sqrt(powers[i].squares[c]);
    }
    return level;
}

// The smallest tiles of a picture, row by row.
struct TileGrid {
    std::size_t width, columns, rows;

    TileGrid(std::size_t picture_width, std::size_t picture_height)
        : width(picture_width),
          columns((picture_width + smallest_tile - 1) / smallest_tile),
          rows((picture_height + smallest_tile - 1) / smallest_tile) {}

    std::size_t count() const { return columns * rows; }
    std::size_t tile_of(std::size_t pixel) const {
        return pixel / width / smallest_tile * columns + pixel % width / smallest_tile;
    }
};

class Differences {
  public:
    Differences(const Image& a, const Image& b, bool exchangeable);

    // Of the differences as they are; then of such with random signs.
    struct Statistic {
        double surprise = 0;  // -log of the smallest p of a size of tile, by asymptotic laws
        double most = 0;      // the largest |t|
    };
    Statistic observed() {
        return statistic([] { return uint64_t{0}; });
    }
    Statistic flipped(std::mt19937_64& random) {
        return statistic([&] { return random(); });
    }

    bool none() const {
        return std::ranges::all_of(pixels_, [](const auto& tile) { return tile.empty(); });
    }

    // How many t the statistic looks at.
    std::size_t count() const {
        std::size_t all = 0;
        for (const Level& level : levels_)
            for (const std::size_t n : level.count) all += n;
        return all;
    }

  private:
    void build_levels(std::size_t columns, std::size_t rows, bool exchangeable);

    template <typename Signs>
    Statistic statistic(const Signs& signs);

    std::vector<std::vector<Radiance>> pixels_;  // differences that are not 0, by smallest tile
    std::vector<Level> levels_;                  // from the smallest tiles to the whole picture
    std::vector<Components> sums_, above_;       // of d, of the tiles of a level and of the next
};

// The radiance around a pixel, by which its difference is divided so that bright pixels do not
// outweigh the others. The pixel itself does not count, or noise would be taken for a difference:
// that of a skewed law is large where the pixel is bright.
class Surroundings {
  public:
    Surroundings(const Image& a, const Image& b, const TileGrid& grid) : tiles_(grid.count()) {
        visit_finite_pixels(
            [&](std::size_t i, const Radiance& x, const Radiance& y) {
                for (Sum* sum : {&tiles_[grid.tile_of(i)], &picture_}) sum->add(size_of(x, y));
            },
            a, b);
    }

    double around(std::size_t tile, const Radiance& x, const Radiance& y) const {
        constexpr double least = 0.1;  // of the picture's mean
        const double others = tiles_[tile].sum - size_of(x, y);
        return others / std::max(tiles_[tile].pixels - 1, 1.0) +
               least * picture_.sum / picture_.pixels;
    }

  private:
    struct Sum {
        double sum = 0, pixels = 0;
        void add(double value) {
            sum += value;
            ++pixels;
        }
    };
    static double size_of(const Radiance& x, const Radiance& y) {
        double size = 0;
        for (std::size_t c = 0; c < 3; ++c) size += std::abs(x[c]) + std::abs(y[c]);
        return size;
    }

    std::vector<Sum> tiles_;
    Sum picture_;
};

Differences::Differences(const Image& a, const Image& b, bool exchangeable) {
    const TileGrid grid(a.width, a.height);
    const Surroundings surroundings(a, b, grid);
    pixels_.resize(grid.count());
    visit_finite_pixels(
        [&](std::size_t i, const Radiance& x, const Radiance& y) {
            const std::size_t tile = grid.tile_of(i);
            const double around = surroundings.around(tile, x, y);
            Radiance d{};
            for (std::size_t c = 0; c < 3; ++c) {
                const double size =
                    std::abs(x[c] - y[c]) - rounding * std::max(std::abs(x[c]), std::abs(y[c]));
                if (size > 0) d[c] = std::copysign(size / around, x[c] - y[c]);
            }
            if (d != Radiance{}) pixels_[tile].push_back(d);
        },
        a, b);
    build_levels(grid.columns, grid.rows, exchangeable);
}

void Differences::build_levels(std::size_t columns, std::size_t rows, bool exchangeable) {
    std::vector<Powers> powers(pixels_.size());
    for (std::size_t tile = 0; tile < pixels_.size(); ++tile)
        for (const Radiance& d : pixels_[tile]) {
            const Components all{d[0], d[1], d[2], d[0] + d[1] + d[2]};
            for (std::size_t c = 0; c < 4; ++c) {
                powers[tile].squares[c] += std::pow(all[c], 2);
                powers[tile].fourths[c] += std::pow(all[c], 4);
            }
        }
    while (true) {
        Level& level = levels_.emplace_back(level_of(powers, exchangeable));
        if (powers.size() == 1) return;
        const std::size_t next_columns = (columns + 1) / 2;
        const std::size_t next_rows = (rows + 1) / 2;
        std::vector<Powers> next(next_columns * next_rows);
        for (std::size_t i = 0; i < powers.size(); ++i) {
            level.tiles[i].parent = i / columns / 2 * next_columns + i % columns / 2;
            next[level.tiles[i].parent].add(powers[i]);
        }
        columns = next_columns;
        rows = next_rows;
        powers = std::move(next);
    }
}

template <typename Signs>
Differences::Statistic Differences::statistic(const Signs& signs) {
    sums_.assign(pixels_.size(), {});
    for (std::size_t tile = 0; tile < pixels_.size(); ++tile) {
        uint64_t bits = signs();
        Radiance sum{};
        for (const Radiance& d : pixels_[tile]) {
            const double sign = bits & 1U ? -1 : 1;
            bits >>= 1U;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += sign * d[c];
        }
        sums_[tile] = {sum[0], sum[1], sum[2], sum[0] + sum[1] + sum[2]};
    }
    Statistic found;
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        const Level& level = levels_[l];
        above_.assign(l + 1 < levels_.size() ? levels_[l + 1].tiles.size() : 1, {});
        Components most{};
        Components squares{};
        for (std::size_t i = 0; i < level.tiles.size(); ++i) {
            const Tile& tile = level.tiles[i];
            for (std::size_t c = 0; c < 4; ++c) {
                const double square = std::pow(sums_[i][c] * tile.scale[c], 2);
                most[c] = std::max(most[c], square);
                squares[c] += square;
                above_[tile.parent][c] += sums_[i][c];
            }
        }
        for (std::size_t c = 0; c < 4; ++c) {
            const auto n = static_cast<double>(level.count[c]);
            if (n == 0) continue;
            found.most = std::max(found.most, std::sqrt(most[c]));
            const double largest = log_tail(std::sqrt(most[c])) + std::log(2 * n);
            const double sum = n > 1 ? log_chi_square_tail(squares[c], n) : 0;
            found.surprise = std::max({found.surprise, -largest, -sum});
        }
        std::swap(sums_, above_);
    }
    return found;
}

bool has_finite_pixels(const Image& a, const Image& b) {
    std::size_t pixels = 0;
    visit_finite_pixels([&](std::size_t, const Radiance&, const Radiance&) { ++pixels; }, a, b);
    return pixels > 0;
}

}  // namespace

std::optional<double> p_of_same_expectation(const Image& a, const Image& b, bool exchangeable) {
    Differences differences(a, b, exchangeable);
    if (differences.none() && has_finite_pixels(a, b)) return 1;
    if (differences.count() == 0) return std::nullopt;
    const Differences::Statistic observed = differences.observed();
    const double bound = 2 * static_cast<double>(differences.count()) *
                         std::exp(-0.5 * observed.most * observed.most);
    constexpr double least = 1e-300;
    if (bound < 1.0 / (most_flips + 1)) return std::max(bound, least);

    std::mt19937_64 random(1);
    std::size_t above = 0;
    for (std::size_t flips = 1; flips <= most_flips; ++flips) {
        if (differences.flipped(random).surprise >= observed.surprise) ++above;
        if (above == enough_above) return static_cast<double>(above) / static_cast<double>(flips);
    }
    return static_cast<double>(above + 1) / (most_flips + 1);
}

}  // namespace wavepath
