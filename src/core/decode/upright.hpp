// Upright: the matrices P as they stand on the pattern, whatever way the grid was found. Paper
// section II-B.6 (last paragraph: symbols and matrices are rotated accordingly).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/fixed.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// A line of signed weights: positive for bit 1.
using Line = std::array<std::int8_t, kMaxGridSide>;

/// Weights of the two bits of a symbol: positive for 1.
struct Bits {
    std::int8_t x = 0;
    std::int8_t y = 0;
};

/// The bits of a cell as they stand on the pattern: a quarter turn takes the displacement (x, y) to
/// (-y, x), and so the projections of eq. 7-8, (y - x, y + x), to (x + y, x - y).
constexpr Bits turned(Turn pattern_from_grid, const GridCell& cell) {
    const auto minus_x = static_cast<std::int8_t>(-cell.x);
    const auto minus_y = static_cast<std::int8_t>(-cell.y);
    switch (pattern_from_grid.quarters) {
        case 1:
            return {cell.y, minus_x};
        case 2:
            return {minus_x, minus_y};
        case 3:
            return {minus_y, cell.x};
        default:
            return {cell.x, cell.y};
    }
}

/// A region of the grid, turned.
class Upright {
  public:
    Upright(const Grid& grid, const Region& region, Turn pattern_from_grid)
        : grid_(grid), region_(region), turn_(pattern_from_grid) {
        const int right = region.i0 + region.columns - 1;
        const int bottom = region.j0 + region.rows - 1;
        const int q = turn_.quarters;
        corner_ = {q == 0 || q == 1 ? region.i0 : right, q == 0 || q == 3 ? region.j0 : bottom};
    }

    int columns() const { return is_sideways() ? region_.rows : region_.columns; }
    int rows() const { return is_sideways() ? region_.columns : region_.rows; }
    /// The grid cell of the top left symbol.
    Vec corner() const { return corner_; }

    /// Weights of the x bits down a column; of the y bits along a row.
    std::span<const std::int8_t> column(int a, Line& line) const {
        for (int b = 0; b < rows(); ++b)
            line[static_cast<std::size_t>(b)] = x_weight(a, b);
        return std::span(line).first(static_cast<std::size_t>(rows()));
    }
    std::span<const std::int8_t> row(int b, Line& line) const {
        for (int a = 0; a < columns(); ++a)
            line[static_cast<std::size_t>(a)] = y_weight(a, b);
        return std::span(line).first(static_cast<std::size_t>(columns()));
    }

  private:
    bool is_sideways() const { return turn_.quarters % 2 == 1; }
    const GridCell& cell(int a, int b) const {
        const Vec c = corner_ + turn_.inverse()({a, b});
        return grid_.at(c.x, c.y);
    }
    std::int8_t x_weight(int a, int b) const { return turned(turn_, cell(a, b)).x; }
    std::int8_t y_weight(int a, int b) const { return turned(turn_, cell(a, b)).y; }

    const Grid& grid_;
    Region region_;
    Turn turn_;
    Vec corner_;
};

}  // namespace dotpose::core
