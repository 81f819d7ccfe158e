// Hard block: stores the bits of a block of cells in one word per line, and provides them in any
// orientation. The roll of a line is the index in the main sequence at which the line starts
// (docs/position-code.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/decode/grid.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/compared_line.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {

/// The bits of a column or row, with one bit per cell in each word. Bit 0 belongs to the first
/// cell.
struct HardLine {
    std::uint32_t bits = 0;
    std::uint32_t seen = 0;  ///< bit i is 1 if the bit of cell i was read

    /// Returns the number of bits that disagree with the main sequence if the line starts at index
    /// `roll` of the sequence.
    int wrong_at(std::size_t roll) const { return bits_in((code::kMainWords[roll] ^ bits) & seen); }
};

/// All lines along one axis of a block, in one orientation.
struct HardLines {
    const HardLine* first = nullptr;
    int step = 1;  ///< index step from one line to the next in memory: 1 or -1
    int count = 0;

    const HardLine& operator[](int line) const { return first[line * step]; }

    /// Returns the number of bits that disagree with the code if the roll of line i is
    /// (rolls[i] + added) mod 63. Stops counting once the result exceeds `limit`.
    int wrong_with(const std::uint8_t* rolls, std::uint32_t added, int limit) const;
    /// Returns the number of bits that disagree with the code if the roll of each line is (r +
    /// added) mod 63, where r is the roll of the line in section 0, taken from `rolls`. Stops
    /// counting once the result exceeds `limit`.
    int wrong_at(const code::RollsAhead& rolls, std::uint32_t added, int limit) const;
    /// Variant of `wrong_at` that computes the rolls. `position` is the position of the first line.
    int wrong_at(CodeVariant code, std::uint32_t position, std::uint32_t added, int limit) const {
        return wrong_at(code::RollsAhead(code, position), added, limit);
    }
};

/// The bits of a block in all four orientations. Only two orientations are stored: the original
/// block, and the block turned by 180 degrees. The lines of every orientation are the lines of one
/// of these two blocks, in forward or reverse order.
class HardBlock {
  public:
    /// Reads the clear cells of a region of at most kMaxComparedLines columns and rows.
    HardBlock(const Grid& grid, const GridRegion& region);

    /// Returns the number of clear cells, which is the number of bits per axis.
    int dots() const { return dots_; }
    /// Returns the lines of the block after `quarters` quarter turns in the direction of
    /// QuarterTurn. The result refers to the memory of this block.
    HardLines lines(Axis axis, int quarters) const;

  private:
    using Lines = std::array<HardLine, kMaxComparedLines>;

    int columns_;
    int rows_;
    int dots_ = 0;
    /// Element 0 contains the block, and element 1 the block turned by 180 degrees.
    std::array<Lines, 2> column_lines_{};
    std::array<Lines, 2> row_lines_{};
};

/// The bits read in a tracked frame, in the orientation of the pattern. The block contains all
/// columns and rows from the first to the last one with bits.
class TrackedBlock {
  public:
    /// `lines` are Tracking::lines, and `corner` is the place of cell (0, 0).
    TrackedBlock(std::span<const ComparedLine> lines, CodeVariant code, const Place& corner);

    HardLines columns() const { return {columns_.data(), 1, column_count_}; }
    HardLines rows() const { return {rows_.data(), 1, row_count_}; }
    /// Returns the place where the first column and the first row cross.
    const Place& corner() const { return corner_; }

  private:
    std::array<HardLine, kMaxComparedLines> columns_;
    std::array<HardLine, kMaxComparedLines> rows_;
    int column_count_;
    int row_count_;
    Place corner_;
};

}  // namespace dotpose::core
