// Coded block: bits that were read next to those that the code has there, as words, so that
// comparing them takes an instruction.
#pragma once

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"

namespace dotpose::core {

/// The middle of an upright block, compared with the code.
class CodedBlock {
  public:
    /// `place` is that of cell (0, 0); `view` has the rolls of all lines that were read.
    CodedBlock(Profile profile, const Place& place, const CellsInView& view, const BitBlock& block);

    /// Returns the bits of one axis; `confidence` is that of all bits read.
    AxisBits axis(Axis axis, const Confidence& confidence) const;

  private:
    struct Half {
        std::array<TrackedLine, kMostTracked> lines;
        std::array<std::uint8_t, kMostTracked> rolls;
        std::size_t first = 0;  ///< the first line that has bits
        std::size_t end = 0;
        AxisReading reading;  ///< of the first line that has bits
    };
    static Half half(const BitLines& lines, const std::uint8_t* rolls, int first_line, int count,
                     int first_cell);

    Half x_;
    Half y_;
};

}  // namespace dotpose::core
