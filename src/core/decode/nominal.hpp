// Nominal: the expected symbols of the cells of a grid whose place in the code is known.
#pragma once

#include <array>

#include "core/decode/grid.hpp"
#include "core/math/fixed.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

/// The symbols that the code assigns to the cells of a grid, given the place and the turn of a
/// decoding.
class Nominal {
  public:
    Nominal(const Grid& grid, CodeVariant code, const Decoding& decoding);

    /// Returns the pattern step of a grid cell: its column and row on the upright pattern, relative
    /// to `Decoding::place`.
    FixedVec pattern_step(FixedVec grid_cell) const { return turn_(grid_cell); }
    /// Returns the symbol at a pattern step. The pattern step must belong to a cell of the grid.
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
