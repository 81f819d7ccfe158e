// Compared lines: the bits read in a column or row, next to the bits of the code.
#pragma once

#include <cstdint>

namespace dotpose::core {

/// Maximum number of columns, and of rows, that are compared bit by bit.
inline constexpr int kMaxComparedLines = 32;

/// A column (or row), with one bit per cell.
struct ComparedLine {
    std::uint32_t code = 0;   ///< bits of the code
    std::uint32_t seen = 0;   ///< 1 if a dot was read
    std::uint32_t wrong = 0;  ///< 1 if the dot read contradicts the code
};

}  // namespace dotpose::core
