// Position -> symbols (paper section II-A), in O(1) per column and row.
#include "code/basis.hpp"
#include "dotpose/code.hpp"

namespace dotpose {

int delta(Profile profile, std::uint32_t p) noexcept {
    unsigned sum = code::kSmallestDelta;
    for (const code::Secondary& a : code::basis(profile)) {
        sum += unsigned{a.weight} * a.digits[p % a.length];
    }
    return static_cast<int>(sum);
}

int roll(Profile profile, std::uint32_t p) noexcept {
    // The sum of p differences, taken apart: p times the constant 5, and for each sequence its
    // whole turns and the digits of the turn begun.
    unsigned sum = code::kSmallestDelta * (p % kSections);
    for (const code::Secondary& a : code::basis(profile)) {
        const std::uint32_t turns = p / a.length;
        const std::uint32_t rest = p - turns * a.length;
        const unsigned digit_sum =
            turns % kSections * a.prefix_sums[a.length] + a.prefix_sums[rest];
        sum += digit_sum * a.weight;
    }
    return static_cast<int>(sum % kSections);
}

int main_bit(std::uint32_t index) noexcept {
    return code::kMain[index % kSections];
}

Symbol symbol_at(Profile profile, Cell cell, Section section) noexcept {
    const auto column_roll = static_cast<std::uint32_t>(roll(profile, cell.x) + section.u);
    const auto row_roll = static_cast<std::uint32_t>(roll(profile, cell.y) + section.v);
    return make_symbol(main_bit(column_roll + cell.y), main_bit(row_roll + cell.x));
}

int section_of(Profile profile, int roll_seen, std::uint32_t position,
               std::uint32_t cross_position) noexcept {
    const auto shift = static_cast<int>(cross_position % kSections);
    return (roll_seen + 2 * kSections - roll(profile, position) - shift) % kSections;
}

Place moved(Profile profile, Place place, std::int32_t dx, std::int32_t dy) noexcept {
    // Going once around x, columns find their rolls shifted by those of a whole turn, and rows read
    // at an x that is a whole turn larger.
    const auto step = [&](std::uint32_t& p, std::int32_t d, std::uint8_t& own,
                          std::uint8_t& cross) {
        const int turn_roll = roll(profile, kPositionsPerAxis);
        constexpr int kTurnShift = kPositionsPerAxis % kSections;
        const std::int64_t target = std::int64_t{p} + d;
        if (target < 0) {
            own = static_cast<std::uint8_t>((own + kSections - turn_roll) % kSections);
            cross = static_cast<std::uint8_t>((cross + kSections - kTurnShift) % kSections);
            p = static_cast<std::uint32_t>(target + kPositionsPerAxis);
        } else if (target >= kPositionsPerAxis) {
            own = static_cast<std::uint8_t>((own + turn_roll) % kSections);
            cross = static_cast<std::uint8_t>((cross + kTurnShift) % kSections);
            p = static_cast<std::uint32_t>(target - kPositionsPerAxis);
        } else {
            p = static_cast<std::uint32_t>(target);
        }
    };
    step(place.cell.x, dx, place.section.u, place.section.v);
    step(place.cell.y, dy, place.section.v, place.section.u);
    return place;
}

}  // namespace dotpose
