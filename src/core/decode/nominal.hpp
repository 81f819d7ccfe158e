// Nominal: the symbols of the code in every cell of the grid, for a known position.
#pragma once

#include <array>

#include "core/decode/grid.hpp"
#include "core/math/fixed.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

/// The symbols of the code in a grid.
class Nominal {
  public:
    Nominal(const Grid& grid, CodeVariant code, const Decoding& decoding);

    /// Returns the position of a grid cell on the pattern, in spacings relative to
    /// `Decoding::place`.
    FixedVec pattern_step(FixedVec grid_cell) const { return turn_(grid_cell); }
    /// Returns the symbol at a position on the pattern, which must be in the grid.
    Symbol symbol(FixedVec pattern_step) const;

  private:
    QuarterTurn turn_;
    FixedVec first_;  ///< minimum pattern step of the cells of the grid
    /// Index in the main sequence of the first cell of each column. `rows_` contains the index of
    /// the first cell of each row.
    std::array<std::uint8_t, kMaxGridSide> columns_;
    std::array<std::uint8_t, kMaxGridSide> rows_;
};

}  // namespace dotpose::core
