// Upright: reads a region of the grid as if the pattern were upright (paper, section II-B.6, last
// paragraph).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/decode/grid.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {

/// Signed weights of the bits in a line. A positive weight favours bit value 1.
using Line = std::array<std::int8_t, kMaxGridSide>;

/// Signed weights of the two bits in a symbol. A positive weight favours bit value 1.
struct Bits {
    std::int8_t x = 0;
    std::int8_t y = 0;
};

/// Returns the bits of a cell after rotation to the upright orientation of the pattern. A quarter
/// turn maps the displacement (x, y) to (-y, x). It therefore maps the projections (y - x, y + x)
/// to (x + y, x - y) (paper, equations 7 and 8).
constexpr Bits turned(QuarterTurn pattern_from_grid, const GridCell& cell) {
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

/// A region of the grid, rotated so that the pattern is upright.
class Upright {
  public:
    Upright(const Grid& grid, const GridRegion& region, QuarterTurn pattern_from_grid)
        : region_(region), turn_(pattern_from_grid) {
        const int right = region.i0 + region.columns - 1;
        const int bottom = region.j0 + region.rows - 1;
        const int q = turn_.quarters;
        corner_ = {q == 0 || q == 1 ? region.i0 : right, q == 0 || q == 3 ? region.j0 : bottom};
        first_ = &grid.at(corner_.x, corner_.y);
        const auto stride = [&](FixedVec step) {
            const FixedVec d = turn_.inverse()(step);
            return d.y * grid.columns + d.x;
        };
        to_right_ = stride({1, 0});
        downwards_ = stride({0, 1});
        // The bits and signs must be the same as in `turned`, which rotates single cells.
        x_bit_ = is_sideways() ? &GridCell::y : &GridCell::x;
        y_bit_ = is_sideways() ? &GridCell::x : &GridCell::y;
        x_sign_ = q == 0 || q == 1 ? 1 : -1;
        y_sign_ = q == 0 || q == 3 ? 1 : -1;
    }

    int columns() const { return is_sideways() ? region_.rows : region_.columns; }
    int rows() const { return is_sideways() ? region_.columns : region_.rows; }
    /// Returns the grid cell of the top left symbol.
    FixedVec corner() const { return corner_; }

    /// Returns the x bit weights of a column, from top to bottom.
    std::span<const std::int8_t> column(int a, Line& line) const {
        return weights(first_ + a * to_right_, downwards_, rows(), x_bit_, x_sign_, line);
    }
    /// Returns the y bit weights of a row, from left to right.
    std::span<const std::int8_t> row(int b, Line& line) const {
        return weights(first_ + b * downwards_, to_right_, columns(), y_bit_, y_sign_, line);
    }

  private:
    bool is_sideways() const { return turn_.quarters % 2 == 1; }
    static std::span<const std::int8_t> weights(const GridCell* cell, int stride, int count,
                                                std::int8_t GridCell::*bit, int sign, Line& line);

    GridRegion region_;
    QuarterTurn turn_;
    FixedVec corner_;
    const GridCell* first_;
    int to_right_;
    int downwards_;
    std::int8_t GridCell::*x_bit_;
    std::int8_t GridCell::*y_bit_;
    int x_sign_;
    int y_sign_;
};

}  // namespace dotpose::core
