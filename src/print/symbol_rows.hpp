/// Computes the symbols of a sheet, one row at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/files/sheet.hpp"

namespace dotpose::print {

/// Computes the symbols of a sheet row by row. Stores the roll of each column (the offset of the
/// main sequence in the column), so that a symbol requires only two table look-ups.
class SymbolRows {
  public:
    explicit SymbolRows(const Sheet& sheet);

    /// Returns the symbols of row `j` of the sheet, from left to right. Valid until the next call.
    const std::vector<Symbol>& row(int j);

  private:
    Sheet sheet_;
    std::vector<std::uint8_t> column_rolls_;
    std::vector<Symbol> symbols_;
};

}  // namespace dotpose::print
