/// Position code: encodes grid intersections as symbols, and decodes windows of symbols.
///
/// The code is described in the paper (section II-A). Every column contains the same cyclic
/// sequence of bits, called *main*, read downwards. The *roll* of a column is the index in *main*
/// of the column's bit in row 0. The rolls of adjacent columns differ by 5 to 58, modulo 63. Each
/// difference consists of four digits, one from each of the cyclic sequences a1 to a4. The lengths
/// of these sequences are coprime, so a few consecutive differences determine the position of a
/// column. The rows encode y in the same way.
///
/// Coordinates: x points right and y points DOWN on the printed page. All functions are pure and
/// thread-safe, and do not allocate memory.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/export.hpp"
#include "dotpose/status.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Number of positions per axis: 236 * 233 * 31 * 241, the product of the lengths of the four digit
/// sequences. The combination of digits repeats after this number of positions.
inline constexpr std::uint32_t kPositionsPerAxis = 410'815'348;
/// Number of sections per axis. Also the length of the main sequence.
inline constexpr int kSections = 63;

/// Variant of the position code. The variants differ only in sequence a4.
enum class CodeVariant : std::uint8_t {
    /// Sequence a4 of the patent, with a misprint corrected (docs/position-code.md). Windows are
    /// unique on the whole plane. The default for printing.
    anoto,
    /// Sequence a4 as misprinted in the patent. Used by libdots and other open tools. Windows
    /// smaller than 8 x 8 symbols may be ambiguous.
    libdots,
    /// Sequence a4 of py-microdots and its ports. Differs from the sequence in the patent.
    microdots,
};
/// Number of code variants.
inline constexpr int kCodeVariantCount = 3;

/// Grid intersection in column x and row y, each in [0, kPositionsPerAxis).
struct Cell {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

/// Section of the code plane, called "sector" in the paper. `u` is the roll of column 0, and `v` is
/// the roll of row 0. Each is in [0, 63).
struct Section {
    std::uint8_t u = 0;
    std::uint8_t v = 0;
    friend constexpr bool operator==(const Section&, const Section&) = default;
};

/// Direction in which a dot is displaced from its intersection. Bit 0 of the value is the x bit,
/// and bit 1 is the y bit.
enum class Symbol : std::uint8_t { up = 0, left = 1, right = 2, down = 3 };

/// Returns the symbol with the given bits. Each bit must be 0 or 1.
constexpr Symbol make_symbol(int x_bit, int y_bit) {
    return static_cast<Symbol>(x_bit | (y_bit << 1));
}
/// Returns the x bit, 0 or 1. The x bits of a column form the main sequence.
constexpr int x_bit(Symbol symbol) {
    return static_cast<int>(symbol) & 1;
}
/// Returns the y bit, 0 or 1. The y bits of a row form the main sequence.
constexpr int y_bit(Symbol symbol) {
    return static_cast<int>(symbol) >> 1 & 1;
}
/// Returns the direction of the displacement along x: -1, 0 or 1.
constexpr int dx(Symbol symbol) {
    return y_bit(symbol) - x_bit(symbol);
}
/// Returns the direction of the displacement along y (down): -1, 0 or 1.
constexpr int dy(Symbol symbol) {
    return x_bit(symbol) + y_bit(symbol) - 1;
}
/// Returns the first letter of the direction: 'u', 'l', 'r' or 'd'.
constexpr char letter(Symbol symbol) {
    return "ulrd"[static_cast<int>(symbol) & 3];
}

/// Returns the difference between adjacent rolls, (roll(p + 1) - roll(p)) mod 63, for columns or
/// rows. The result is in [5, 58]. p must be in [0, kPositionsPerAxis).
int delta(CodeVariant code, std::uint32_t p) noexcept;

/// Returns the roll of column (or row) p in section 0, in O(1). The result is in [0, 63). `p` may
/// be kPositionsPerAxis or more, but it does not wrap around: roll(p + kPositionsPerAxis) generally
/// differs from roll(p).
int roll(CodeVariant code, std::uint32_t p) noexcept;

/// Returns one bit of the cyclic main sequence. The index wraps around.
int main_bit(std::uint32_t index) noexcept;

/// Returns the symbol at one intersection, in O(1). When encoding a whole page, it is faster to
/// call `roll` once per column and once per row.
Symbol symbol_at(CodeVariant code, Cell cell, Section section) noexcept;

/// Rectangle of symbols, stored row by row. Must have 6 to 32 columns and 6 to 32 rows.
struct SymbolWindow {
    std::span<const Symbol> symbols;  ///< columns * rows symbols
    int columns = 0;
    int rows = 0;
};

/// Place in the code: a cell in a section. The place of a window is the place of its top left
/// symbol.
struct Place {
    Cell cell;
    Section section;
    friend constexpr bool operator==(const Place&, const Place&) = default;
};

/// Returns the place that is (dx, dy) intersections away from `place`. |dx| and |dy| must be less
/// than kPositionsPerAxis. At the ends of an axis, places wrap around into a different section.
Place moved(CodeVariant code, Place place, std::int32_t dx, std::int32_t dy) noexcept;

/// Decodes an upright window in which all symbols are correct. Sets `place` only if the window
/// occurs exactly once in the code. Errors:
/// - bad_window: the number of columns or rows is outside [6, 32], or there are fewer than
///   columns * rows symbols.
/// - not_in_code: the code does not contain the window.
/// - ambiguous: the window occurs at several places. Possible only for `libdots` windows smaller
///   than 8 x 8.
Status decode(CodeVariant code, const SymbolWindow& window, Place& place) noexcept;

/// Computes the position of the first of 6 to 32 adjacent columns (or rows) from their rolls. Each
/// roll must be in [0, 63). All rolls must be measured in the same row (or column), which need not
/// be row (or column) 0. Returns bad_window if the number of rolls is outside [6, 32]. Returns
/// not_in_code and ambiguous in the same cases as `decode`.
Status position_from_rolls(CodeVariant code, std::span<const std::uint8_t> rolls,
                           std::uint32_t& position) noexcept;

/// Computes `Section::u` from the column at `position`, or `Section::v` from the row at `position`.
/// `roll_seen` is the main-sequence index of the bit at which this column (or row) crosses row (or
/// column) `cross_position`.
int section_of(CodeVariant code, int roll_seen, std::uint32_t position,
               std::uint32_t cross_position) noexcept;

}  // namespace dotpose

DOTPOSE_END_EXPORT
