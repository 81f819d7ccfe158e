// Position -> symbols (paper section II-A), in O(1) per column and row.
#include "code/basis.hpp"
#include "dotpose/code.hpp"

namespace dotpose {

int delta(Profile profile, std::uint32_t p) noexcept {
    unsigned sum = code::kSmallestDelta;
    for (const code::Secondary& a : code::basis(profile)) {
        sum += unsigned{a.weight} * a.digits[a.place_of(p)];
    }
    return static_cast<int>(sum);
}

int roll(Profile profile, std::uint32_t p) noexcept {
    // The sum of p differences, taken apart: p times the constant 5, and for each sequence its
    // whole turns and the digits of the turn begun. The turns are the lines in them divided by
    // their length, which modulo 63 is a multiplication.
    const std::uint32_t lines = code::modulo_sections(p) + 4 * kSections;
    std::uint32_t sum = code::kSmallestDelta * lines;
    for (const code::Secondary& a : code::basis(profile)) {
        const std::uint32_t place = a.place_of(p);
        sum += (lines - place) * a.turn_roll + a.rolls[place];
    }
    return static_cast<int>(code::modulo_sections(sum));
}

int main_bit(std::uint32_t index) noexcept {
    return code::kMain[code::modulo_sections(index)];
}

Symbol symbol_at(Profile profile, Cell cell, Section section) noexcept {
    const auto column_roll = static_cast<std::uint32_t>(roll(profile, cell.x) + section.u);
    const auto row_roll = static_cast<std::uint32_t>(roll(profile, cell.y) + section.v);
    return make_symbol(main_bit(column_roll + cell.y), main_bit(row_roll + cell.x));
}

int section_of(Profile profile, int roll_seen, std::uint32_t position,
               std::uint32_t cross_position) noexcept {
    const auto shift = static_cast<int>(code::modulo_sections(cross_position));
    return static_cast<int>(code::modulo_sections(
        static_cast<std::uint32_t>(roll_seen + 2 * kSections - roll(profile, position) - shift)));
}

Place moved(Profile profile, Place place, std::int32_t dx, std::int32_t dy) noexcept {
    // Going once around x, columns find their rolls shifted by those of a whole turn, and rows read
    // at an x that is a whole turn larger.
    const auto step = [&](std::uint32_t& p, std::int32_t d, std::uint8_t& own,
                          std::uint8_t& cross) {
        const auto turn_roll = [&] { return roll(profile, kPositionsPerAxis); };
        constexpr int kTurnShift = kPositionsPerAxis % kSections;
        const std::int64_t target = std::int64_t{p} + d;
        if (target < 0) {
            own = static_cast<std::uint8_t>((own + kSections - turn_roll()) % kSections);
            cross = static_cast<std::uint8_t>((cross + kSections - kTurnShift) % kSections);
            p = static_cast<std::uint32_t>(target + kPositionsPerAxis);
        } else if (target >= kPositionsPerAxis) {
            own = static_cast<std::uint8_t>((own + turn_roll()) % kSections);
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
