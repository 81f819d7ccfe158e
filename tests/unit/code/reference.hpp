// A reference implementation of the position code, written from section II-A of the paper. It uses
// loops instead of tables, and a separate copy of the sequences (patent US 6,667,695). It shares
// only types with src/code.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dotpose/code.hpp"

namespace dotpose::code_test {

inline constexpr std::array kCodeVariants{CodeVariant::anoto, CodeVariant::libdots,
                                          CodeVariant::microdots};
inline constexpr std::uint32_t kL = 236U * 233U * 31U * 241U;

inline constexpr std::string_view kMainText =
    "000000100111110100100001110111001010100010110110011010111100011";
inline constexpr std::string_view kA1Text =
    "000001000020100101002000110001200102002020110101102012010120210011101111021010211001210112"
    "000210202111002120111202001121000220102200122020221012121021211022121202202220112211012222"
    "12002211212210222220212221112112012212201211112220021122";
inline constexpr std::string_view kA2Text =
    "000001000020100101011000111100110100200012010121000211101110210012121010201102001021200022"
    "001120200202012002211002101121020221002221012200212211111200122120111211201211122022011222"
    "21212201222020211221022021021102222010221222112120222";
inline constexpr std::string_view kA3Text = "0000010011000111100101011011101";
inline constexpr std::string_view kA4RestoredText =
    "000001020000200201000112000120021000211201010012100100220002210201100111010110120111100202"
    "012022010210121101112200101222002220121202001220112102110202120011021210102202102211120211"
    "1022220202212111121212221002122101122112112222120122122022211";
inline constexpr std::string_view kA4PublishedText =
    "000001020000200201000112000120021000211201010012100100220002210201100111010110120111100202"
    "012022010210121101112200101222002220121202001220112102110202120011021210102202102211120211"
    "1022220202212111121212221002122101122112122221201221220222111";
inline constexpr std::string_view kA4MicrodotsText =
    "000022220222102220022120221102210022000212202121021200211202111021100210002022020210202002"
    "010020000122201221012200121201211012100120001122011210112001112011112222122211221112122121"
    "2112111110111001100010220102101020010120201201011020110101001";

/// Returns the sequences a1 to a4 of a code variant.
inline std::array<std::string_view, 4> secondary_texts(CodeVariant code) {
    switch (code) {
        case CodeVariant::anoto:
            return {kA1Text, kA2Text, kA3Text, kA4RestoredText};
        case CodeVariant::libdots:
            return {kA1Text, kA2Text, kA3Text, kA4PublishedText};
        case CodeVariant::microdots:
            return {kA1Text, kA2Text, kA3Text, kA4MicrodotsText};
    }
    return {};
}

inline constexpr std::array<int, 4> kWeights{1, 3, 9, 18};

inline int digit_at(std::string_view text, std::uint64_t index) {
    return text[index % text.size()] - '0';
}

inline int reference_delta(CodeVariant code, std::uint64_t p) {
    const auto texts = secondary_texts(code);
    int d = 5;
    for (std::size_t n = 0; n < texts.size(); ++n)
        d += kWeights[n] * digit_at(texts[n], p);
    return d;
}

/// Returns the roll at position p: the sum of the differences before p, modulo 63. Whole periods of
/// each sequence are added first, and then the remaining digits.
inline int reference_roll(CodeVariant code, std::uint64_t p) {
    const auto texts = secondary_texts(code);
    std::uint64_t sum = 5 * p;
    for (std::size_t n = 0; n < texts.size(); ++n) {
        std::uint64_t turn = 0;
        std::uint64_t rest = 0;
        for (std::size_t i = 0; i < texts[n].size(); ++i) {
            const auto digit = static_cast<std::uint64_t>(texts[n][i] - '0');
            turn += digit;
            if (i < p % texts[n].size()) rest += digit;
        }
        sum += static_cast<std::uint64_t>(kWeights[n]) * (p / texts[n].size() * turn + rest);
    }
    return static_cast<int>(sum % 63);
}

/// A window that owns its symbols.
struct Grid {
    int columns = 0;
    int rows = 0;
    std::vector<Symbol> symbols;

    [[nodiscard]] SymbolWindow window() const { return {symbols, columns, rows}; }
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row * columns + column);
    }
    friend bool operator==(const Grid&, const Grid&) = default;
};

/// Displacement of a dot from its intersection, to the right and down (see the table in
/// docs/position-code.md).
struct Displacement {
    int right = 0;
    int down = 0;
    friend bool operator==(const Displacement&, const Displacement&) = default;
};

inline constexpr std::array<std::pair<Symbol, Displacement>, 4> kDisplacements{{
    {Symbol::up, {0, -1}},
    {Symbol::left, {-1, 0}},
    {Symbol::right, {1, 0}},
    {Symbol::down, {0, 1}},
}};

inline Symbol symbol_of_bits(int x, int y) {
    if (x == 0) return y == 0 ? Symbol::up : Symbol::right;
    return y == 0 ? Symbol::left : Symbol::down;
}

inline Symbol symbol_of_letter(char c) {
    switch (c) {
        case 'u':
            return Symbol::up;
        case 'l':
            return Symbol::left;
        case 'r':
            return Symbol::right;
        default:
            return Symbol::down;
    }
}

/// Returns the window at `place`. The window may extend past position L.
inline Grid reference_window(CodeVariant code, const Place& place, int columns, int rows) {
    const auto rolls = [code](std::uint64_t start, int section, int count) {
        std::vector<int> result{reference_roll(code, start) + section};
        for (int i = 0; i + 1 < count; ++i) {
            result.push_back(result.back() +
                             reference_delta(code, start + static_cast<std::uint64_t>(i)));
        }
        return result;
    };
    const auto column_rolls = rolls(place.cell.x, place.section.u, columns);
    const auto row_rolls = rolls(place.cell.y, place.section.v, rows);
    Grid grid{columns, rows, {}};
    grid.symbols.reserve(static_cast<std::size_t>(columns * rows));
    const auto x0 = static_cast<int>(place.cell.x % 63);
    const auto y0 = static_cast<int>(place.cell.y % 63);
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const int down = column_rolls[static_cast<std::size_t>(c)] + y0 + r;
            const int right = row_rolls[static_cast<std::size_t>(r)] + x0 + c;
            grid.symbols.push_back(
                symbol_of_bits(digit_at(kMainText, static_cast<std::uint64_t>(down)),
                               digit_at(kMainText, static_cast<std::uint64_t>(right))));
        }
    }
    return grid;
}

/// Returns the symbol as seen after turning the page clockwise by a quarter turn. With y down, this
/// maps the vector (right, down) to (-down, right).
inline Symbol turned(Symbol symbol) {
    for (const auto& [from, d] : kDisplacements) {
        if (from != symbol) continue;
        for (const auto& [to, e] : kDisplacements) {
            if (e == Displacement{-d.down, d.right}) return to;
        }
    }
    return symbol;
}

/// Returns the window as seen after turning the page clockwise by a quarter turn. The bottom left
/// symbol moves to the top left.
inline Grid turned(const Grid& grid) {
    Grid result{grid.rows, grid.columns, grid.symbols};
    for (int r = 0; r < grid.rows; ++r) {
        for (int c = 0; c < grid.columns; ++c) {
            result.symbols[result.index(grid.rows - 1 - r, c)] =
                turned(grid.symbols[grid.index(c, r)]);
        }
    }
    return result;
}

/// Returns true if `place` is valid and the pattern at `place` is `grid`.
inline bool shows(CodeVariant code, const Place& place, const Grid& grid) {
    return place.cell.x < kL && place.cell.y < kL && place.section.u < 63 && place.section.v < 63 &&
           reference_window(code, place, grid.columns, grid.rows) == grid;
}

template <typename Rng>
int random_int(Rng& rng, int first, int last) {
    return std::uniform_int_distribution<int>(first, last)(rng);
}

template <typename Rng>
Place random_place(Rng& rng) {
    std::uniform_int_distribution<std::uint32_t> position(0, kL - 1);
    return {{position(rng), position(rng)},
            {static_cast<std::uint8_t>(random_int(rng, 0, 62)),
             static_cast<std::uint8_t>(random_int(rng, 0, 62))}};
}

inline std::string describe(CodeVariant code, const Place& place) {
    return "code " + std::to_string(static_cast<int>(code)) + " cell (" +
           std::to_string(place.cell.x) + ", " + std::to_string(place.cell.y) + ") section (" +
           std::to_string(place.section.u) + ", " + std::to_string(place.section.v) + ")";
}

}  // namespace dotpose::code_test
