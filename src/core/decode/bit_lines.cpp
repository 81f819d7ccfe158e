#include "core/decode/bit_lines.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "code/tables.hpp"
#include "core/decode/exact_lines.hpp"
#include "core/decode/search.hpp"
#include "core/decode/tuning.hpp"

namespace dotpose::core {
namespace {

std::uint64_t reversed(std::uint64_t word) {
    const auto swap = [&](std::uint64_t mask, int by) {
        word = (word >> by & mask) | (word & mask) << by;
    };
    swap(0x5555555555555555U, 1);
    swap(0x3333333333333333U, 2);
    swap(0x0F0F0F0F0F0F0F0FU, 4);
    return __builtin_bswap64(word);
}

/// Returns the lines in reverse order. The bits within a line keep their order.
BitLines in_opposite_order(const BitLines& lines) {
    BitLines result = lines;
    std::reverse(result.bits.begin(), result.bits.end());
    std::reverse(result.valid.begin(), result.valid.end());
    return result;
}

/// Returns each line as it appears after a half turn: reversed, with all bits flipped. The lines
/// keep their order.
BitLines backwards(const BitLines& lines) {
    BitLines result;
    for (std::size_t i = 0; i < lines.bits.size(); ++i) {
        if (lines.valid[i] == 0) continue;
        result.bits[i] = reversed(~lines.bits[i]);
        result.valid[i] = reversed(lines.valid[i]);
    }
    return result;
}

/// Returns the range from the first to the last line that has a valid bit. If the range has more
/// than `max_count` lines, keeps the lines nearest the middle of the block.
LineRange lines_with_bits(const BitLines& lines, int max_count) {
    int first = 0;
    int last = BitBlock::kSide - 1;
    while (first < BitBlock::kSide && lines.valid[static_cast<std::size_t>(first)] == 0)
        ++first;
    while (last > first && lines.valid[static_cast<std::size_t>(last)] == 0)
        --last;
    const int count = std::max(last - first + 1, 0);
    if (count <= max_count) return {first, count};
    return {std::clamp(BitBlock::kMiddle - max_count / 2, first, last + 1 - max_count), max_count};
}

/// Returns the best score of a line after a half turn, minus its best score as read. If the line is
/// exact (see `exact_roll`) in only one of the two directions, skips the scoring: returns
/// 127 (n - 6) if the line is exact after the half turn, or -127 (n - 6) if it is exact as read,
/// where n is the number of valid bits. Six bits are subtracted, because the main sequence contains
/// almost every string of six bits.
int backwardness(const Kernels& kernels, std::uint64_t bits, std::uint64_t valid) {
    const std::uint64_t back = reversed(~bits);
    const std::uint64_t valid_back = reversed(valid);
    const bool is_exact = exact_roll(bits, valid) != code::kAbsent;
    const bool is_exact_back = exact_roll(back, valid_back) != code::kAbsent;
    constexpr int kWeight = 127;
    if (is_exact != is_exact_back) {
        const int score = kWeight * (std::popcount(valid) - code::kMainOrder);
        return is_exact ? -score : score;
    }
    ScoredLine forwards;
    ScoredLine backwards;
    kernels.score_line(bits, valid, forwards);
    kernels.score_line(back, valid_back, backwards);
    return backwards.best.score - forwards.best.score;
}

/// Sums `backwardness` over several lines. Stops early if the magnitude of the sum reaches
/// `tuning::turns::kLandslide`.
int backwardness(const Kernels& kernels, const BitLines& lines) {
    constexpr int kVoters = tuning::turns::kVotersOfBits;
    const LineRange range = lines_with_bits(lines, BitBlock::kSide);
    int sum = 0;
    for (int voter = 0; voter < kVoters; ++voter) {
        // The voting lines are in the middle half of the range, because lines are longest there.
        const auto i = static_cast<std::size_t>(range.first + range.count / 4 +
                                                range.count * voter / (2 * kVoters));
        if (i >= lines.bits.size()) break;
        sum += backwardness(kernels, lines.bits[i], lines.valid[i]);
        if (std::abs(sum) >= tuning::turns::kLandslide) break;
    }
    return sum;
}

/// Finds the place of cell (0, 0). `find` is the function that finds the position on one axis.
bool find_place_with(decltype(find_axis) find, CodeVariant code, const BlockLines& lines,
                     Place& place) {
    constexpr int kMinLines = 6;
    if (lines.columns.count() < kMinLines || lines.rows.count() < kMinLines) return false;
    AxisReading x;
    AxisReading y;
    if (find(code, lines.columns, x) != Status::ok || find(code, lines.rows, y) != Status::ok)
        return false;
    place = place_of_middle(code, lines.first_column, lines.first_row, x, y);
    return true;
}

Lines score_lines(const Kernels& kernels, const BitLines& lines, const LineRange& which,
                  int first_cell, std::span<ScoredLine> storage) {
    const auto count = static_cast<std::size_t>(which.count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t line = static_cast<std::size_t>(which.first) + i;
        kernels.score_line(lines.bits[line] >> first_cell, lines.valid[line] >> first_cell,
                           storage[i]);
    }
    return {storage.first(count)};
}

}  // namespace

BlockRanges ranges_with_bits(const BitBlock& block, int max_count) {
    return {lines_with_bits(block.columns, max_count), lines_with_bits(block.rows, max_count)};
}

int likeliest_turn(const Kernels& kernels, const BitBlock& block) {
    const bool columns_backwards = backwardness(kernels, block.columns) > 0;
    const bool rows_backwards = backwardness(kernels, block.rows) > 0;
    if (columns_backwards) return rows_backwards ? 2 : 1;
    return rows_backwards ? 3 : 0;
}

BitBlock turned(int quarters, const BitBlock& block) {
    switch (quarters) {
        case 1:
            return {in_opposite_order(block.rows), backwards(block.columns)};
        case 2:
            return {in_opposite_order(backwards(block.columns)),
                    in_opposite_order(backwards(block.rows))};
        case 3:
            return {backwards(block.rows), in_opposite_order(block.columns)};
        default:
            return block;
    }
}

FloatPlane turned(int quarters, const FloatPlane& p) {
    switch (quarters) {
        case 1:
            return {-1 - p.at_y, p.at_x,   -p.du_y,  p.du_x, -p.dv_y,
                    p.dv_x,      p.tilt_x, p.tilt_y, p.bend};
        case 2:
            return {-1 - p.at_x, -1 - p.at_y, -p.du_x,  -p.du_y, -p.dv_x,
                    -p.dv_y,     p.tilt_x,    p.tilt_y, p.bend};
        case 3:
            return {p.at_y,  -1 - p.at_x, p.du_y,   -p.du_x, p.dv_y,
                    -p.dv_x, p.tilt_x,    p.tilt_y, p.bend};
        default:
            return p;
    }
}

BlockLines score_block(const Kernels& kernels, const BitBlock& block,
                       std::span<ScoredLine> storage) {
    const int max_count = static_cast<int>(storage.size() / 2);
    const auto [columns, rows] = ranges_with_bits(block, max_count);
    return {columns.first, rows.first,
            score_lines(kernels, block.columns, columns, rows.first, scores_of(Axis::x, storage)),
            score_lines(kernels, block.rows, rows, columns.first, scores_of(Axis::y, storage))};
}

Place place_of_middle(CodeVariant code, int first_column, int first_row, const AxisReading& column,
                      const AxisReading& row) {
    const auto section = [&](const AxisReading& own, const AxisReading& other) {
        return static_cast<std::uint8_t>(section_of(code, own.roll, own.position, other.position));
    };
    const Place corner{{column.position, row.position},
                       {section(column, row), section(row, column)}};
    return moved(code, corner, BitBlock::kMiddle - first_column, BitBlock::kMiddle - first_row);
}

bool find_place(CodeVariant code, const BlockLines& lines, Place& place) {
    return find_place_with(find_axis_briefly, code, lines, place);
}

bool find_place_thoroughly(CodeVariant code, const BlockLines& lines, Place& place) {
    return find_place_with(find_axis, code, lines, place);
}

}  // namespace dotpose::core
