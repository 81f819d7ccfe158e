/// Gives out parts of the code plane that share no cell.
#pragma once

#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::print {

/// Regions stand side by side to the right of `start`. One that would run past the end of the plane
/// begins a new line below all regions of the line before.
class Regions {
  public:
    explicit Regions(Cell start) : start_(start), next_(start) {}

    /// Top left cell of a new region. One that does not fit the plane anywhere gets a cell from
    /// which it runs past the end, which `validate` refuses.
    Cell take(int columns, int rows);

  private:
    Cell start_;
    Cell next_;
    std::uint32_t line_rows_ = 0;
};

}  // namespace dotpose::print
