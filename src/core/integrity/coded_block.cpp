#include "core/integrity/coded_block.hpp"

#include <algorithm>
#include <bit>

#include "code/tables.hpp"

namespace dotpose::core {
namespace {

/// Index of the first compared line, and also of the first compared cell in each line. `kFirst` is
/// relative to cell (0, 0), and `kFirstOfBlock` is relative to the first cell of a BitBlock.
constexpr int kFirst = -kMaxComparedLines / 2;
constexpr auto kFirstOfBlock = static_cast<std::size_t>(BitBlock::kMiddle + kFirst);

/// Returns the longest run of ones in `bits`, as a mask.
std::uint32_t longest_run(std::uint32_t bits) {
    if (const std::uint32_t beyond = bits + (bits & (0 - bits)); (beyond & bits) == 0) return bits;
    std::uint32_t longest = 0;
    int max_length = 0;
    for (std::uint32_t rest = bits; rest != 0;) {
        const int first = std::countr_zero(rest);
        const int length = std::countr_one(rest >> first);
        const std::uint32_t run = ~std::uint32_t{0} >> (32 - length) << first;
        if (length > max_length) longest = run;
        max_length = std::max(max_length, length);
        rest &= ~run;
    }
    return longest;
}

}  // namespace

/// Compares lines of one axis with the code. rolls[i] is the roll of line first_line + i at the
/// cell `first_cell`, for i < count. Lines outside the middle kMaxComparedLines lines of the block
/// are ignored.
CodedBlock::Half CodedBlock::half(const BitLines& lines, const std::uint8_t* rolls, int first_line,
                                  int count, int first_cell) {
    Half half;
    // The main sequence is cyclic, so the first compared cell may be before `first_cell`.
    const int ahead = ((kFirst - first_cell) % kSections + kSections) % kSections;
    const int begin = std::max(first_line, kFirst);
    const int end = std::min(first_line + count, kFirst + kMaxComparedLines);
    for (int line = begin; line < end; ++line) {
        const auto i = static_cast<std::size_t>(line - kFirst);
        const auto seen =
            static_cast<std::uint32_t>(lines.valid[kFirstOfBlock + i] >> kFirstOfBlock);
        const auto bits =
            static_cast<std::uint32_t>(lines.bits[kFirstOfBlock + i] >> kFirstOfBlock);
        const int there = rolls[line - first_line] + ahead;
        const int roll = there < kSections ? there : there - kSections;
        const std::uint32_t code = code::kMainWords[static_cast<std::size_t>(roll)];
        const std::uint32_t wrong = (bits ^ code) & seen;
        // If a line has no wrong bits, keeps only its longest run of bits, because the tables in
        // likelihood_ratios.cpp require runs without gaps. Ignoring correct bits can only increase
        // the odds of alternatives.
        half.rolls[i] = static_cast<std::uint8_t>(roll);
        half.lines[i] = {code, wrong == 0 ? longest_run(seen) : seen, wrong};
        if (seen == 0) continue;
        if (half.end == 0) {
            half.first = i;
            half.reading.roll = half.rolls[i];
        }
        half.end = i + 1;
    }
    return half;
}

CodedBlock::CodedBlock(CodeVariant code, const Place& place, const CellsInView& view,
                       const BitBlock& block)
    : x_(half(block.columns, view.column_rolls, view.first_column, view.columns, view.first_row)),
      y_(half(block.rows, view.row_rolls, view.first_row, view.rows, view.first_column)) {
    const Place corner = moved(code, place, kFirst + static_cast<int>(x_.first),
                               kFirst + static_cast<int>(y_.first));
    x_.reading.position = corner.cell.x;
    y_.reading.position = corner.cell.y;
}

AxisBits CodedBlock::axis(Axis axis, const Confidence& confidence) const {
    const Half& half = axis == Axis::x ? x_ : y_;
    const std::size_t count = half.end - half.first;
    return {std::span(half.lines).subspan(half.first, count), half.reading, confidence,
            std::span(half.rolls).subspan(half.first, count)};
}

}  // namespace dotpose::core
