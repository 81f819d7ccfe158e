// Coded block: the bits that were read and the bits of the code, packed into one word per line. A
// single instruction can then compare a whole line.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"
#include "core/integrity/compared_line.hpp"

namespace dotpose::core {

/// The middle 32 x 32 cells of an upright block, compared with the code.
class CodedBlock {
  public:
    /// Constructs the comparison for a block whose cell (0, 0) is at `place`. `view` contains the
    /// rolls of all lines that were read.
    CodedBlock(CodeVariant code, const Place& place, const CellsInView& view,
               const BitBlock& block);

    /// Returns the bits of one axis. `confidence` must cover all bits that were read, including
    /// bits outside the middle cells.
    AxisBits axis(Axis axis, const Confidence& confidence) const;

  private:
    /// The lines of one axis.
    struct Half {
        std::array<ComparedLine, kMaxComparedLines> lines;
        std::array<std::uint8_t, kMaxComparedLines> rolls;
        std::size_t first = 0;  ///< first line with bits
        std::size_t end = 0;    ///< one past the last line with bits
        AxisReading reading;    ///< position and roll of line `first`
    };
    static Half half(const BitLines& lines, const std::uint8_t* rolls, int first_line, int count,
                     int first_cell);

    Half x_;
    Half y_;
};

}  // namespace dotpose::core
