/// The symbols of a sheet, one row at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/tools/sheet.hpp"

namespace dotpose::print {

/// Keeps one roll per column, so that a symbol costs two look-ups instead of a closed form.
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
