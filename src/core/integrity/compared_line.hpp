// Compared lines: the bits read in a column or row, and the code's bits in the same cells.
#pragma once

#include <cstdint>

namespace dotpose::core {

/// Maximum number of lines per axis that are compared bit by bit.
inline constexpr int kMaxComparedLines = 32;

/// A column or row. Each word has one bit per cell. Bit 0 is the first cell.
struct ComparedLine {
    std::uint32_t code = 0;   ///< bits of the code
    std::uint32_t seen = 0;   ///< 1 if the bit of the cell was read
    std::uint32_t wrong = 0;  ///< 1 if the bit was read and differs from `code`
};

}  // namespace dotpose::core
