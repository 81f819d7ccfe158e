// Bit lines: the bits of 64 x 64 cells as words, a column or a row each, so that turning, comparing
// and counting them takes an instruction. Paper sections II-B.4 to II-B.7, with bits that are read
// or not instead of probabilities.
#pragma once

#include "core/decode/lines.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Bits of a block of cells: x bits by column, y bits by row. Cell (0, 0) has the number kMiddle.
struct BitBlock {
    static constexpr int kSide = 64;
    static constexpr int kMiddle = 32;
    BitLines columns;
    BitLines rows;
};

/// The lines of a block that are scored.
struct BlockLines {
    int first_column = 0;
    int first_row = 0;
    Lines columns;
    Lines rows;
};

/// Eq. 7-9's quarter turn from the grid to the pattern, by what most lines near the middle speak
/// for: the pattern's cell (a, b) is the block's turned, see `turned`.
int likeliest_turn(const Kernels& kernels, const BitBlock& block);

/// The block as it stands on the pattern. Its cells are counted so that (i, j) becomes (i, j),
/// (-1 - j, i), (-1 - i, -1 - j) or (j, -1 - i).
BitBlock turned(int quarters, const BitBlock& block);
FloatPlane turned(int quarters, const FloatPlane& grid_from_image);

/// Scores of all lines of an upright block that have bits, at most half the storage of each kind:
/// those around the middle.
BlockLines score_block(const Kernels& kernels, const BitBlock& block,
                       std::span<ScoredLine> storage);

/// The place of cell (0, 0) of an upright block. False if the lines spell no position.
bool find_place(Profile profile, const BlockLines& lines, Place& place);

}  // namespace dotpose::core
