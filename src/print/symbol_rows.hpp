/// Computes the symbols of a sheet, one row at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/files/sheet.hpp"

namespace dotpose::print {

/// Keeps the offset of the main sequence (its roll) of each column, so that a symbol takes two
/// table look-ups instead of the formula for any cell.
class SymbolRows {
  public:
    explicit SymbolRows(const Sheet& sheet);

    /// Symbols of row `j` (0 is the sheet's first), left to right; valid until the next call.
    const std::vector<Symbol>& row(int j);

  private:
    Sheet sheet_;
    std::vector<std::uint8_t> column_rolls_;
    std::vector<Symbol> symbols_;
};

}  // namespace dotpose::print
