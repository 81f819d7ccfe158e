#include "core/decode/exact_lines.hpp"

#include <array>
#include <bit>

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/decode/search.hpp"

namespace dotpose::core {
namespace {

/// Index of each six-bit string in the main sequence. The first bit is the lowest bit.
constexpr auto kIndexOfBits = [] {
    std::array<std::uint8_t, 64> indices{};
    indices.fill(code::kAbsent);
    for (std::size_t i = 0; i < kSections; ++i)
        indices[code::kMainWords[i] & 63] = static_cast<std::uint8_t>(i);
    return indices;
}();

int below_sections(int roll) {
    return roll < kSections ? roll : roll - kSections;
}

/// Decodes the position of the first line in a range, and the roll of this line at cell
/// `first_cell`. Returns false in these cases:
/// - There are too few adjacent exact lines (see `exact_roll`).
/// - The code does not contain the rolls of these lines.
/// - The number of wrong bits in the range exceeds half the number of lines.
bool find_axis_exactly(CodeVariant code, const BitLines& lines, const LineRange& range,
                       int first_cell, AxisReading& reading) {
    const auto count = static_cast<std::size_t>(range.count);
    const auto bits = [&](std::size_t i) {
        return lines.bits[static_cast<std::size_t>(range.first) + i] >> first_cell;
    };
    const auto valid = [&](std::size_t i) {
        return lines.valid[static_cast<std::size_t>(range.first) + i] >> first_cell;
    };
    const auto length = static_cast<std::size_t>(run_length(code));
    std::array<std::uint8_t, BitBlock::kSide> rolls;
    // Skips the first quarter of the lines, because the lines near the middle are longer and more
    // reliable.
    std::size_t end = count / 4;
    for (std::size_t run = 0; run < length; ++end) {
        if (end == count) return false;
        rolls[end] = exact_roll(bits(end), valid(end));
        run = rolls[end] == code::kAbsent ? 0 : run + 1;
    }
    const std::size_t begin = end - length;
    std::uint32_t position = 0;
    if (position_from_rolls(code, std::span(rolls).subspan(begin, length), position) !=
        Status::ok) {
        return false;
    }
    const std::uint8_t roll = rolls[begin];
    reading = reading_of_first(code, position, roll, static_cast<int>(begin),
                               std::span(rolls).first(count));
    int wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const int here = below_sections(reading.roll + rolls[i]);
        // Counts the wrong bits one at a time, because most lines have none and many processors
        // have no popcount instruction.
        std::uint64_t differ =
            (bits(i) ^ code::main_bits(static_cast<std::size_t>(here))) & valid(i);
        for (; differ != 0; differ &= differ - 1)
            ++wrong;
    }
    return 2 * wrong <= range.count;
}

}  // namespace

std::uint8_t exact_roll(std::uint64_t bits, std::uint64_t valid) {
    const std::uint64_t two = valid & valid >> 1;
    const std::uint64_t six = two & two >> 2 & two >> 4;
    if (six == 0) return code::kAbsent;
    const int cell = std::countr_zero(six);
    const std::uint8_t there = kIndexOfBits[bits >> cell & 63];
    if (there == code::kAbsent) return code::kAbsent;
    const int roll = below_sections(there + kSections - cell);
    return ((bits ^ code::main_bits(static_cast<std::size_t>(roll))) & valid) == 0
               ? static_cast<std::uint8_t>(roll)
               : code::kAbsent;
}

bool find_place_exactly(CodeVariant code, const BitBlock& block, Place& place) {
    const BlockRanges ranges = ranges_with_bits(block, BitBlock::kSide);
    AxisReading x;
    AxisReading y;
    if (!find_axis_exactly(code, block.columns, ranges.columns, ranges.rows.first, x) ||
        !find_axis_exactly(code, block.rows, ranges.rows, ranges.columns.first, y)) {
        return false;
    }
    place = place_of_middle(code, ranges.columns.first, ranges.rows.first, x, y);
    return true;
}

}  // namespace dotpose::core
