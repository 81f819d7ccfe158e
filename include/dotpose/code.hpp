/// Position code: returns the symbol at each grid intersection, and decodes the position of a
/// window of symbols.
///
/// Paper section II-A. Every column of the pattern contains the cyclic *main* sequence, which is
/// read downwards. The *roll* of a column is the offset at which the sequence starts. The rolls of
/// adjacent columns differ by 5 to 58, modulo 63. Each difference has four digits, one from each of
/// the cyclic sequences a1 to a4, whose lengths are coprime. The digits of consecutive differences
/// determine the position of the column. Rows encode y in the same way.
///
/// Coordinate frame: x to the right, y DOWN, as the printed page is read. All functions are pure
/// and thread-safe, and do not allocate.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/export.hpp"
#include "dotpose/status.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Number of positions per axis: 236 * 233 * 31 * 241, the common period of the four digit
/// sequences.
inline constexpr std::uint32_t kPositionsPerAxis = 410'815'348;
/// Length of the main sequence, and number of sections per axis.
inline constexpr int kSections = 63;

/// Variant of the position code. Variants differ only in the sequence a4.
enum class CodeVariant : std::uint8_t {
    /// The a4 restored from the misprint in the patent (docs/position-code.md). Unambiguous on the
    /// whole plane. The default for printing.
    anoto,
    /// The a4 as misprinted in the patent, used by libdots and other open tools. Windows smaller
    /// than 8 x 8 symbols may be ambiguous.
    libdots,
    /// Another a4, used by py-microdots and its ports.
    microdots,
};
/// Number of values of CodeVariant.
inline constexpr int kCodeVariantCount = 3;

/// A grid intersection: column x and row y, each in [0, kPositionsPerAxis).
struct Cell {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

/// Section of the code: the rolls of column 0 (u) and of row 0 (v), each in [0, 63). The paper
/// calls a section a "sector".
struct Section {
    std::uint8_t u = 0;
    std::uint8_t v = 0;
    friend constexpr bool operator==(const Section&, const Section&) = default;
};

/// The direction in which a dot is displaced from its intersection. Bit 0 is the x bit, bit 1 the y
/// bit.
enum class Symbol : std::uint8_t { up = 0, left = 1, right = 2, down = 3 };

/// Returns the symbol with the given bits, each 0 or 1.
constexpr Symbol make_symbol(int x_bit, int y_bit) {
    return static_cast<Symbol>(x_bit | (y_bit << 1));
}
/// Returns the x bit, which is the bit of the column: 0 or 1.
constexpr int x_bit(Symbol symbol) {
    return static_cast<int>(symbol) & 1;
}
/// Returns the y bit, which is the bit of the row: 0 or 1.
constexpr int y_bit(Symbol symbol) {
    return static_cast<int>(symbol) >> 1 & 1;
}
/// Returns the displacement of the dot along x, in units of the displacement length: -1, 0 or 1.
constexpr int dx(Symbol symbol) {
    return y_bit(symbol) - x_bit(symbol);
}
/// Returns the displacement of the dot along y (down), in units of the displacement length: -1, 0
/// or 1.
constexpr int dy(Symbol symbol) {
    return x_bit(symbol) + y_bit(symbol) - 1;
}
/// Returns 'u', 'l', 'r' or 'd'.
constexpr char letter(Symbol symbol) {
    return "ulrd"[static_cast<int>(symbol) & 3];
}

/// Returns the roll of column (or row) p + 1 minus the roll of column (or row) p, modulo 63, in [5,
/// 58]. p must be in [0, kPositionsPerAxis).
int delta(CodeVariant code, std::uint32_t p) noexcept;

/// Returns, in O(1), the roll of column (or row) p in section 0: the offset, in [0, 63), at which
/// the main sequence starts. `p` may exceed kPositionsPerAxis. Rolls are not periodic: the roll of
/// p + kPositionsPerAxis differs from the roll of p.
int roll(CodeVariant code, std::uint32_t p) noexcept;

/// Returns one bit of the cyclic main sequence. Any index is valid.
int main_bit(std::uint32_t index) noexcept;

/// Returns, in O(1), the symbol at one intersection. For whole pages, call `roll` once per column
/// and row instead.
Symbol symbol_at(CodeVariant code, Cell cell, Section section) noexcept;

/// A rectangle of symbols, row by row, with 6 to 32 columns and rows.
struct SymbolWindow {
    std::span<const Symbol> symbols;  ///< columns * rows symbols
    int columns = 0;
    int rows = 0;
};

/// A place in the code: a cell in a section. The place of a window is the place of its top left
/// symbol.
struct Place {
    Cell cell;
    Section section;
    friend constexpr bool operator==(const Place&, const Place&) = default;
};

/// Returns the place that is (dx, dy) intersections away from `place`. |dx| and |dy| must be less
/// than kPositionsPerAxis. If the result is beyond either end of an axis, it wraps around to the
/// other end, where the pattern continues in another section.
Place moved(CodeVariant code, Place place, std::int32_t dx, std::int32_t dy) noexcept;

/// Decodes an upright window that contains no wrong symbols. Sets `place` only if the window occurs
/// exactly once in the code. Errors: bad_window (not 6 to 32 columns and rows, or fewer than
/// columns * rows symbols), not_in_code, ambiguous (only for `libdots`, where windows below 8 x 8
/// may occur at several places).
Status decode(CodeVariant code, const SymbolWindow& window, Place& place) noexcept;

/// Computes the position of the first column (or row) from the rolls of 6 to 32 consecutive columns
/// (rows), each in [0, 63) and all read from the same row (column). Returns the same errors as
/// `decode`.
Status position_from_rolls(CodeVariant code, std::span<const std::uint8_t> rolls,
                           std::uint32_t& position) noexcept;

/// Returns the section, in [0, 63), from the roll of column (row) `position`. `roll_seen` is the
/// roll counted from row (column) `cross_position`: the offset in the main sequence of the bit in
/// that row (column).
int section_of(CodeVariant code, int roll_seen, std::uint32_t position,
               std::uint32_t cross_position) noexcept;

}  // namespace dotpose

DOTPOSE_END_EXPORT
