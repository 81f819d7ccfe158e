// Builds a grid, as read by the decoder, from a rectangle of the code plane in any orientation.
#pragma once

#include <cstdint>
#include <vector>

#include "core/decode/grid.hpp"
#include "core/decode/upright.hpp"
#include "dotpose/code.hpp"
#include "dotpose/known_region.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test {

/// Size, orientation and errors of a drawn rectangle.
struct Drawing {
    int columns = 6;
    int rows = 6;
    int quarters = 0;    ///< number of quarter turns from the grid to the pattern
    double wrong = 0;    ///< probability that a bit is wrong
    double missing = 0;  ///< probability that a cell is missing
};

/// A grid that contains the bits of a rectangle on a known sheet.
class DrawnGrid {
  public:
    /// `at` is the upper left cell of the rectangle.
    DrawnGrid(const KnownRegion& sheet, Cell at, const Drawing& drawing, Rng& rng) {
        const QuarterTurn from_pattern = QuarterTurn{drawing.quarters}.inverse();
        const FixedVec last = from_pattern({drawing.columns - 1, drawing.rows - 1});
        grid_.i0 = std::min(last.x, 0);
        grid_.j0 = std::min(last.y, 0);
        grid_.columns = std::abs(last.x) + 1;
        grid_.rows = std::abs(last.y) + 1;
        cells_.resize(static_cast<std::size_t>(grid_.columns * grid_.rows));
        grid_.storage = cells_;
        for (int j = 0; j < drawing.rows; ++j) {
            for (int i = 0; i < drawing.columns; ++i) {
                const Place place = moved(sheet.code, {at, sheet.section}, i, j);
                const Symbol symbol = symbol_at(sheet.code, place.cell, place.section);
                const int x = x_bit(symbol) ^ static_cast<int>(rng.uniform() < drawing.wrong);
                const int y = y_bit(symbol) ^ static_cast<int>(rng.uniform() < drawing.wrong);
                if (rng.uniform() < drawing.missing) continue;
                const core::Bits bits = core::turned(from_pattern, {weight_of(x), weight_of(y), 0});
                const FixedVec cell = from_pattern({i, j});
                grid_.at(cell.x, cell.y) = {bits.x, bits.y, 0};
            }
        }
    }
    const core::Grid& grid() const { return grid_; }
    GridRegion region() const { return {grid_.i0, grid_.j0, grid_.columns, grid_.rows}; }

  private:
    static std::int8_t weight_of(int bit) {
        return bit != 0 ? std::int8_t{127} : std::int8_t{-127};
    }

    std::vector<GridCell> cells_;
    core::Grid grid_;
};

}  // namespace dotpose::core_test
