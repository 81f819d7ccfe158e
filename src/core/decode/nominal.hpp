// Nominal: the symbol that the code puts at every cell of the grid, once the position is known.
#pragma once

#include <array>

#include "core/math/fixed.hpp"
#include "core/stages.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

/// The symbols that the code has in a grid.
class Nominal {
  public:
    Nominal(const Grid& grid, Profile profile, const Decoding& decoding);

    /// Returns the position of a grid cell on the pattern, relative to `Decoding::place`, in
    /// spacings.
    Vec pattern_step(Vec grid_cell) const { return turn_(grid_cell); }
    /// Returns the symbol at a position on the pattern that lies in the grid.
    Symbol symbol(Vec pattern_step) const;

  private:
    Turn turn_;
    Vec first_;  ///< least pattern step of the grid's cells
    /// Index in the main sequence of the first cell of each column and row.
    std::array<std::uint8_t, kMaxGridSide> columns_;
    std::array<std::uint8_t, kMaxGridSide> rows_;
};

}  // namespace dotpose::core
