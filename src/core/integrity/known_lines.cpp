#include "core/integrity/known_lines.hpp"

#include <bit>

namespace dotpose::core {

int number_of_bits(const BitLines& lines) {
    int bits = 0;
    for (const std::uint64_t valid : lines.valid)
        bits += std::popcount(valid);
    return bits;
}

ScoredAxis::ScoredAxis(const Kernels& kernels, const BitLines& lines, const LineRange& range,
                       int first_cell)
    : kernels_(kernels) {
    constexpr int kWeight = 127;
    scores_.count = range.count;
    for (int i = 0; i < range.count; ++i) {
        const auto line = static_cast<std::size_t>(range.first + i);
        ScoredLine scored;
        kernels.score_line(lines.bits[line] >> first_cell, lines.valid[line] >> first_cell, scored);
        const int bits = std::popcount(lines.valid[line]);
        auto& twice = scores_.lines[static_cast<std::size_t>(i)];
        for (std::size_t roll = 0; roll < kSections; ++roll)
            twice[roll] = static_cast<std::uint16_t>((scored.scores[roll] / kWeight + bits) / 2);
        std::copy_n(twice.begin(), kSections, twice.begin() + kSections);
        std::fill(twice.begin() + 2 * kSections, twice.end(), std::uint16_t{0});
    }
}

int ScoredAxis::agreeing(CodeVariant code, std::uint32_t position, std::size_t added) const {
    std::array<std::uint8_t, BitBlock::kSide> rolls;
    code::follow_rolls(code, position, roll(code, position),
                       std::span(rolls).first(static_cast<std::size_t>(count())));
    int sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count()); ++i)
        sum += scores_.lines[i][rolls[i] + added];
    return sum;
}

}  // namespace dotpose::core
