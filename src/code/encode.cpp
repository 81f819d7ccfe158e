// Encoding: computes the symbol at any place in constant time (paper, section II-A).
#include "code/basis.hpp"
#include "dotpose/code.hpp"

namespace dotpose {

int delta(CodeVariant code, std::uint32_t p) noexcept {
    unsigned sum = code::kMinDelta;
    for (const code::Secondary& a : code::basis(code)) {
        sum += unsigned{a.weight} * a.digit(a.place_of(p));
    }
    return static_cast<int>(sum);
}

int roll(CodeVariant code, std::uint32_t p) noexcept {
    // The roll is the sum of all roll differences before p, modulo 63. Each difference is 5 plus
    // the weighted digits of a1 to a4. For each whole period before p, a sequence contributes the
    // sum of its weighted digits over the period. For the current period, it contributes the sum of
    // its weighted digits before `place`:
    //
    //     roll = 5 p + sum over a1 to a4 of (periods * rolls[length] + rolls[place])
    //     periods = (p - place) / length
    //
    // Modulo 63, the division by `length` is a multiplication by its inverse. This inverse times
    // rolls[length] is `period_roll`. `lines` is used instead of p, because `lines` is small and
    // congruent to p modulo 63. The term 4 * 63 keeps `lines - place` positive.
    const std::uint32_t lines = code::modulo_sections(p) + 4 * kSections;
    std::uint32_t sum = code::kMinDelta * lines;
    for (const code::Secondary& a : code::basis(code)) {
        const std::uint32_t place = a.place_of(p);
        sum += (lines - place) * a.period_roll + a.rolls[place];
    }
    return static_cast<int>(code::modulo_sections(sum));
}

int main_bit(std::uint32_t index) noexcept {
    return code::kMain[code::modulo_sections(index)];
}

Symbol symbol_at(CodeVariant code, Cell cell, Section section) noexcept {
    const auto column_roll = static_cast<std::uint32_t>(roll(code, cell.x) + section.u);
    const auto row_roll = static_cast<std::uint32_t>(roll(code, cell.y) + section.v);
    return make_symbol(main_bit(column_roll + cell.y), main_bit(row_roll + cell.x));
}

int section_of(CodeVariant code, int roll_seen, std::uint32_t position,
               std::uint32_t cross_position) noexcept {
    const auto shift = static_cast<int>(code::modulo_sections(cross_position));
    return static_cast<int>(code::modulo_sections(
        static_cast<std::uint32_t>(roll_seen + 2 * kSections - roll(code, position) - shift)));
}

namespace {

/// A place on one axis. `own` is the section of this axis, and `cross` is the section of the other
/// axis.
struct AxisPlace {
    std::uint32_t position;
    std::uint8_t own;
    std::uint8_t cross;
};

/// Moves `place` to the position `target`, which is outside [0, L), and wraps it around. L is
/// kPositionsPerAxis. Not inlined, because the function is rarely called.
[[gnu::noinline]] AxisPlace wrapped(CodeVariant code, AxisPlace place, std::int64_t target) {
    // A move by L along x changes the column section by roll(L), because the rolls of columns p and
    // p + L differ by roll(L). It also advances L cells along the main sequence in each row, so the
    // row section changes by L modulo 63. The same applies to y with columns and rows exchanged.
    const bool is_before = target < 0;
    const auto shifted = [&](int section, int by) {
        const int sum = section + (is_before ? kSections - by : by);
        return static_cast<std::uint8_t>(sum % kSections);
    };
    place.own = shifted(place.own, roll(code, kPositionsPerAxis));
    place.cross = shifted(place.cross, kPositionsPerAxis % kSections);
    const std::int64_t period = kPositionsPerAxis;
    place.position = static_cast<std::uint32_t>(is_before ? target + period : target - period);
    return place;
}

/// Moves a place by `distance` positions.
AxisPlace moved(CodeVariant code, AxisPlace place, std::int32_t distance) {
    const std::int64_t target = std::int64_t{place.position} + distance;
    if (target < 0 || target >= kPositionsPerAxis) return wrapped(code, place, target);
    place.position = static_cast<std::uint32_t>(target);
    return place;
}

}  // namespace

Place moved(CodeVariant code, Place place, std::int32_t dx, std::int32_t dy) noexcept {
    const AxisPlace x = moved(code, {place.cell.x, place.section.u, place.section.v}, dx);
    const AxisPlace y = moved(code, {place.cell.y, x.cross, x.own}, dy);
    return {{x.position, y.position}, {y.cross, y.own}};
}

}  // namespace dotpose
