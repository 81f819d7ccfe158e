#include "code/rolls.hpp"

#include <algorithm>
#include <array>

#include "code/basis.hpp"

namespace dotpose::code {

int roll_from(CodeVariant code, std::uint32_t position, int section, std::uint32_t cross) {
    const auto sum = static_cast<std::uint32_t>(roll(code, position) + section);
    return static_cast<int>(modulo_sections(sum + modulo_sections(cross)));
}

int roll_further(CodeVariant read, CodeVariant other, std::uint32_t position, std::uint32_t place) {
    // For each code, computes the contribution of a4 to the roll in the same way as `roll` does.
    // kPeriods is a multiple of 63 that exceeds any contribution. Adding it keeps the difference
    // between two contributions positive.
    constexpr std::uint32_t kPeriods = 512 * kSections;
    const std::uint32_t lines = modulo_sections(position) + 4 * kSections;
    const auto by_a4 = [&](CodeVariant code) {
        const Secondary& a4 = basis(code)[3];
        return (lines - place) * a4.period_roll + a4.rolls[place];
    };
    return static_cast<int>(modulo_sections(by_a4(other) + kPeriods - by_a4(read)));
}

void follow_rolls(CodeVariant code, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls) {
    const Basis& sequences = basis(code);
    std::uint32_t sum = static_cast<std::uint32_t>(first_roll) + 4 * kSections;
    while (true) {
        std::array<const std::uint8_t*, 4> here;
        for (std::size_t k = 0; k < here.size(); ++k) {
            here[k] = sequences[k].rolls + sequences[k].place_of(position);
            sum -= *here[k];
        }
        const auto roll_at = [&](std::size_t i) {
            return short_modulo_sections(sum + here[0][i] + here[1][i] + here[2][i] + here[3][i] +
                                         kMinDelta * static_cast<std::uint32_t>(i));
        };
        const std::size_t count = std::min(rolls.size(), kLinesAhead - 1);
        for (std::size_t i = 0; i < count; ++i)
            rolls[i] = static_cast<std::uint8_t>(roll_at(i));
        rolls = rolls.subspan(count);
        if (rolls.empty()) return;
        sum = roll_at(count) + 4 * kSections;
        position += static_cast<std::uint32_t>(count);
    }
}

void follow_rolls(CodeVariant code, std::uint32_t position, int section, std::uint32_t cross,
                  std::span<std::uint8_t> rolls) {
    const std::uint32_t added =
        modulo_sections(static_cast<std::uint32_t>(section) + modulo_sections(cross));
    while (!rolls.empty()) {
        const RollsAhead ahead(code, position);
        const std::size_t count = std::min(rolls.size(), kLinesAhead);
        for (std::size_t i = 0; i < count; ++i)
            rolls[i] = static_cast<std::uint8_t>(ahead.at(static_cast<std::uint32_t>(i), added));
        rolls = rolls.subspan(count);
        position += static_cast<std::uint32_t>(count);
    }
}

// `sum_` is the sum that `roll` computes, without the terms `rolls[place]` of the four sequences.
// `at` adds these terms.
RollsAhead::RollsAhead(CodeVariant code, std::uint32_t position)
    : sequences_(basis(code)),
      lines_(modulo_sections(position) + 4 * kSections),
      sum_(kMinDelta * lines_) {
    for (std::size_t k = 0; k < here_.size(); ++k)
        add(sequences_[k], k, sequences_[k].place_of(position));
    sum_ = modulo_sections(sum_);
}

void RollsAhead::advance() {
    sum_ = kMinDelta * lines_;
    for (std::size_t k = 0; k < here_.size(); ++k) {
        const Secondary& sequence = sequences_[k];
        auto place = static_cast<std::uint32_t>(here_[k] - sequence.rolls) + kSections;
        while (place >= sequence.length)
            place -= sequence.length;
        add(sequence, k, place);
    }
    sum_ = modulo_sections(sum_);
}

}  // namespace dotpose::code
