/// Allocates regions of the code plane that share no cell.
#pragma once

#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::print {

/// Places regions side by side to the right of `start`. A region that would run past the right end
/// of the plane begins a new row, below all regions of the previous row.
class Regions {
  public:
    explicit Regions(Cell start) : start_(start), next_(start) {}

    /// Returns the top left cell of a new region. If the region fits nowhere, it would run past the
    /// end of the plane from this cell, and `validate` refuses it.
    Cell take(int columns, int rows);

  private:
    Cell start_;
    Cell next_;
    std::uint32_t line_rows_ = 0;
};

}  // namespace dotpose::print
