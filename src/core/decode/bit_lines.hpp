// Bit lines: the bits of 64 x 64 cells, stored as one word for each column or row. A few
// instructions rotate a line, compare it, or count its bits. Paper sections II-B.4 to II-B.7, with
// hard bits instead of probabilities.
#pragma once

#include "core/decode/lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// The bits of a block of cells: x bits by column, y bits by row. Cell (0, 0) is at index kMiddle
/// of its column and of its row.
struct BitBlock {
    static constexpr int kSide = 64;
    static constexpr int kMiddle = 32;
    BitLines columns;
    BitLines rows;
};

/// A range of adjacent lines of a block.
struct LineRange {
    int first = 0;
    int count = 0;
};
struct BlockRanges {
    LineRange columns;
    LineRange rows;
};

/// Returns the columns and rows that have bits: at most `max_count` of each, from the middle.
BlockRanges ranges_with_bits(const BitBlock& block, int max_count);

/// The lines of a block that are scored, and the cell indices of the first column and row.
struct BlockLines {
    int first_column = 0;
    int first_row = 0;
    Lines columns;
    Lines rows;
};

/// Returns the number of quarter turns from the grid to the pattern, by a vote of lines near the
/// middle. `turned` applies these quarter turns.
int likeliest_turn(const Kernels& kernels, const BitBlock& block);

/// Returns the block rotated to the upright orientation of the pattern. 0 to 3 quarter turns map
/// cell (i, j) to (i, j), (-1 - j, i), (-1 - i, -1 - j) or (j, -1 - i).
BitBlock turned(int quarters, const BitBlock& block);
/// Returns the plane rotated like the block. The result maps image points to cells of the rotated
/// block.
FloatPlane turned(int quarters, const FloatPlane& grid_from_image);

/// Scores the lines of an upright block that have bits. Half of the storage is for columns and half
/// for rows. If half of the storage is too small for all lines, the middle lines are scored.
BlockLines score_block(const Kernels& kernels, const BitBlock& block,
                       std::span<ScoredLine> storage);

/// Returns the place of cell (0, 0) of an upright block, from the readings of the column with index
/// `first_column` and the row with index `first_row`.
Place place_of_middle(CodeVariant code, int first_column, int first_row, const AxisReading& column,
                      const AxisReading& row);

/// Finds the place of cell (0, 0) of an upright block. Returns false if the lines have no position
/// in the code.
bool find_place(CodeVariant code, const BlockLines& lines, Place& place);

}  // namespace dotpose::core
