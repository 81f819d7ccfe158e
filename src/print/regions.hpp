/// Allocates disjoint regions of the code plane.
#pragma once

#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::print {

/// Allocates regions side by side, from left to right, beginning at `start`. A region that would
/// extend past the right end of the plane is placed in a new row, below all regions of the current
/// row.
class Regions {
  public:
    explicit Regions(Cell start) : start_(start), next_(start) {}

    /// Returns the top left cell of a new region. If there is no space left for it, the region
    /// extends past the end of the plane, and `validate` rejects it.
    Cell take(int columns, int rows);

  private:
    Cell start_;
    Cell next_;
    std::uint32_t line_rows_ = 0;
};

}  // namespace dotpose::print
