#include "symbol_rows.hpp"

namespace dotpose::print {

SymbolRows::SymbolRows(const Sheet& sheet)
    : sheet_(sheet),
      column_rolls_(static_cast<std::size_t>(sheet.columns)),
      symbols_(static_cast<std::size_t>(sheet.columns)) {
    const Pattern& pattern = sheet_.pattern;
    std::uint32_t x = sheet_.origin.x;
    for (std::uint8_t& column_roll : column_rolls_) {
        column_roll =
            static_cast<std::uint8_t>((roll(pattern.code, x++) + pattern.section.u) % kSections);
    }
}

const std::vector<Symbol>& SymbolRows::row(int j) {
    // Each column contains the main sequence from top to bottom, and each row contains it from left
    // to right (paper, section II-A).
    const Pattern& pattern = sheet_.pattern;
    const std::uint32_t y = sheet_.origin.y + static_cast<std::uint32_t>(j);
    const auto row_roll = static_cast<std::uint32_t>(roll(pattern.code, y) + pattern.section.v);
    std::uint32_t x = sheet_.origin.x;
    for (std::size_t i = 0; i < symbols_.size(); ++i, ++x) {
        symbols_[i] = make_symbol(main_bit(column_rolls_[i] + y), main_bit(row_roll + x));
    }
    return symbols_;
}

}  // namespace dotpose::print
