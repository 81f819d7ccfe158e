// Bit lines: the bits of a 64 x 64 block of cells, stored as one 64-bit word per column and one per
// row. Reversing a line, comparing two lines or counting the bits in a line takes only a few
// instructions. The decoder follows the paper (sections II-B.4 to II-B.7), but uses hard bits (0, 1
// or not read) instead of probabilities.
#pragma once

#include "core/decode/lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// A block of cells. `columns` contains the x bits, and `rows` contains the y bits. Column kMiddle
/// and row kMiddle intersect in grid cell (0, 0).
struct BitBlock {
    static constexpr int kSide = 64;
    static constexpr int kMiddle = 32;
    BitLines columns;
    BitLines rows;
};

struct LineRange {
    int first = 0;
    int count = 0;
};
struct BlockRanges {
    LineRange columns;
    LineRange rows;
};

/// Returns, for each axis, the range from the first to the last line that has a valid bit. If a
/// range has more than `max_count` lines, keeps the lines nearest the middle of the block.
BlockRanges ranges_with_bits(const BitBlock& block, int max_count);

/// The scored lines of a block. `first_column` and `first_row` are the indices, within the block,
/// of the first scored column and the first scored row.
struct BlockLines {
    int first_column = 0;
    int first_row = 0;
    Lines columns;
    Lines rows;
};

/// Returns the most likely turn from the grid to the pattern, in quarter turns (0 to 3). The turn
/// is chosen by a vote of a few columns and rows near the middle of the block. Passing the result
/// to `turned` as `quarters` makes the block upright.
int likeliest_turn(const Kernels& kernels, const BitBlock& block);

/// Rotates a block by `quarters` quarter turns. One quarter turn moves cell (i, j) to (-1 - j, i),
/// two move it to (-1 - i, -1 - j), and three move it to (j, -1 - i).
BitBlock turned(int quarters, const BitBlock& block);
/// Rotates a plane by `quarters` quarter turns. The result maps image points to cells of the
/// rotated block.
FloatPlane turned(int quarters, const FloatPlane& grid_from_image);

/// Scores the columns and rows of an upright block. Skips empty lines at both ends of each axis.
/// The column scores are stored in the first half of `storage`, and the row scores in the second
/// half. If a half is too small, scores only the lines nearest the middle of the block.
BlockLines score_block(const Kernels& kernels, const BitBlock& block,
                       std::span<ScoredLine> storage);

/// Returns the place of cell (0, 0) in an upright block. `column` is the reading of the columns,
/// starting at column `first_column`. `row` is the reading of the rows, starting at row
/// `first_row`.
Place place_of_middle(CodeVariant code, int first_column, int first_row, const AxisReading& column,
                      const AxisReading& row);

/// Finds the place of cell (0, 0) in an upright block. Returns false if there are fewer than six
/// columns or rows, or if `find_axis_briefly` finds no position on one of the axes.
bool find_place(CodeVariant code, const BlockLines& lines, Place& place);

/// Variant of `find_place` that tries more combinations of rolls (see `find_axis`). It also finds
/// the places of blocks in which most lines are too short to determine their rolls, but takes many
/// times as long.
bool find_place_thoroughly(CodeVariant code, const BlockLines& lines, Place& place);

}  // namespace dotpose::core
