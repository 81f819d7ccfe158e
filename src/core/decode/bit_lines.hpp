// Bit lines: the bits of 64 x 64 cells, stored as one word for each column and one word for each
// row. Reversing or comparing a line, or counting its bits, takes only a few instructions.
// Implements paper sections II-B.4 to II-B.7 with hard bits (0, 1 or not read) instead of
// probabilities.
#pragma once

#include "core/decode/lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// The bits of a block of cells. The x bits are stored by column, and the y bits are stored by row.
/// Cell (0, 0) of the grid is in column kMiddle and row kMiddle of the block.
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

/// Returns the range from the first to the last column that contains bits, and the range from the
/// first to the last row that contains bits. Each range is limited to the `max_count` lines nearest
/// to the middle of the block.
BlockRanges ranges_with_bits(const BitBlock& block, int max_count);

/// The scored lines of a block. `first_column` and `first_row` are the indices of the first scored
/// column and the first scored row in the block.
struct BlockLines {
    int first_column = 0;
    int first_row = 0;
    Lines columns;
    Lines rows;
};

/// Returns the most likely number of quarter turns (0 to 3) from the grid to the pattern. The
/// number is determined by a vote of the columns and rows near the middle of the block. `turned`
/// applies this rotation.
int likeliest_turn(const Kernels& kernels, const BitBlock& block);

/// Returns the block rotated by `quarters` quarter turns. 0, 1, 2 and 3 quarter turns map cell (i,
/// j) to (i, j), (-1 - j, i), (-1 - i, -1 - j) and (j, -1 - i), respectively.
BitBlock turned(int quarters, const BitBlock& block);
/// Returns the plane rotated by `quarters` quarter turns. The result maps image points to cells of
/// the rotated block.
FloatPlane turned(int quarters, const FloatPlane& grid_from_image);

/// Scores the columns and rows of an upright block, except for empty lines at the ends of each
/// axis. The columns are stored in the first half of `storage`, and the rows are stored in the
/// second half. If half of `storage` is too small for the lines of an axis, scores only the lines
/// nearest to the middle of the block.
BlockLines score_block(const Kernels& kernels, const BitBlock& block,
                       std::span<ScoredLine> storage);

/// Returns the place of cell (0, 0) of an upright block. `column` is the reading of the column with
/// index `first_column` in the block, and `row` is the reading of the row with index `first_row`.
Place place_of_middle(CodeVariant code, int first_column, int first_row, const AxisReading& column,
                      const AxisReading& row);

/// Finds the place of cell (0, 0) of an upright block. Returns false if there are fewer than six
/// columns or rows, or if the search finds no position in the code.
bool find_place(CodeVariant code, const BlockLines& lines, Place& place);

}  // namespace dotpose::core
