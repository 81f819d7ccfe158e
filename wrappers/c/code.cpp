// C functions for the position code. They return the displacements of dots.
#include "dotpose/code.hpp"

#include <algorithm>
#include <array>

#include "convert.hpp"

namespace {

using namespace dotpose;

constexpr std::int32_t kMaxCells = 65535;

/// Number of columns in a block. The roll of each column in a block is computed once and used for
/// all rows.
constexpr std::uint32_t kBlock_columns = 64;

bool are_sides(std::int32_t columns, std::int32_t rows) {
    return columns >= 1 && columns <= kMaxCells && rows >= 1 && rows <= kMaxCells;
}

/// Writes the symbols of a block of columns. `width` is the number of columns in the whole
/// rectangle, and therefore the row stride of `symbols`.
void write_block(CodeVariant code, const dotpose_place& first, std::uint32_t columns,
                 std::uint32_t rows, std::uint8_t* symbols, std::size_t width) {
    std::array<std::uint32_t, kBlock_columns> column_bits;
    for (std::uint32_t i = 0; i < columns; ++i)
        column_bits[i] = static_cast<std::uint32_t>(roll(code, first.x + i)) + first.u + first.y;
    for (std::uint32_t j = 0; j < rows; ++j, symbols += width) {
        const std::uint32_t row_bits =
            static_cast<std::uint32_t>(roll(code, first.y + j)) + first.v + first.x;
        for (std::uint32_t i = 0; i < columns; ++i) {
            symbols[i] = static_cast<std::uint8_t>(
                make_symbol(main_bit(column_bits[i] + j), main_bit(row_bits + i)));
        }
    }
}

}  // namespace

extern "C" {

dotpose_status dotpose_displacement(int32_t code, const dotpose_place* place, int32_t* x,
                                    int32_t* y) {
    if (place == nullptr || x == nullptr || y == nullptr) return DOTPOSE_NULL_POINTER;
    if (!c::is_code(code) || !c::is_place(*place)) return DOTPOSE_BAD_VALUE;
    const Place at = c::to_core(*place);
    const Symbol symbol = symbol_at(static_cast<CodeVariant>(code), at.cell, at.section);
    *x = dx(symbol);
    *y = dy(symbol);
    return DOTPOSE_OK;
}

dotpose_status dotpose_symbols(int32_t code, const dotpose_place* top_left, int32_t columns,
                               int32_t rows, uint8_t* symbols, size_t bytes) {
    if (top_left == nullptr || symbols == nullptr) return DOTPOSE_NULL_POINTER;
    if (!c::is_code(code) || !c::is_place(*top_left) || !are_sides(columns, rows))
        return DOTPOSE_BAD_VALUE;
    const auto width = static_cast<std::uint32_t>(columns);
    const auto height = static_cast<std::uint32_t>(rows);
    // `width` and `height` are less than 2^16, so the product does not overflow.
    if (bytes < width * height) return DOTPOSE_TOO_LITTLE_MEMORY;
    dotpose_place first = *top_left;
    for (std::uint32_t i = 0; i < width; i += kBlock_columns) {
        first.x = top_left->x + i;
        write_block(static_cast<CodeVariant>(code), first, std::min(kBlock_columns, width - i),
                    height, symbols + i, width);
    }
    return DOTPOSE_OK;
}
}
