// Nominal: the symbol that the code puts at every cell of the grid, once the position is known.
#pragma once

#include <array>

#include "core/math/fixed.hpp"
#include "core/stages.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

class Nominal {
  public:
    Nominal(const Grid& grid, Profile profile, const Decoding& decoding);

    /// Position of a grid cell on the pattern, relative to `Decoding::place`, in spacings.
    Vec pattern_step(Vec grid_cell) const { return turn_(grid_cell); }
    Symbol symbol(Vec pattern_step) const;

  private:
    Turn turn_;
    Vec first_;  ///< least pattern step of the grid's cells
    /// Index in the main sequence of the first cell of each.
    std::array<std::uint8_t, kMaxGridSide> columns_;
    std::array<std::uint8_t, kMaxGridSide> rows_;
};

}  // namespace dotpose::core
