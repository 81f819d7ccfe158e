// Nominal: the symbols that the code predicts for a grid at a known place.
#pragma once

#include <array>

#include "core/decode/grid.hpp"
#include "core/math/fixed.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

/// The predicted symbol of each grid cell, given the place and turn of a decoding.
class Nominal {
  public:
    Nominal(const Grid& grid, CodeVariant code, const Decoding& decoding);

    /// Returns the column and row of a grid cell in the upright pattern, relative to
    /// `Decoding::place`.
    FixedVec pattern_step(FixedVec grid_cell) const { return turn_(grid_cell); }
    /// Returns the symbol at a column and row of the upright pattern. The cell must be in the grid.
    Symbol symbol(FixedVec pattern_step) const;

  private:
    QuarterTurn turn_;
    FixedVec first_;  ///< smallest column and smallest row of the grid in the upright pattern
    /// Main-sequence index of the first cell of each column (`columns_`) and each row (`rows_`).
    std::array<std::uint8_t, kMaxGridSide> columns_;
    std::array<std::uint8_t, kMaxGridSide> rows_;
};

}  // namespace dotpose::core
