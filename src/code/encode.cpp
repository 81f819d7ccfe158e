// Encoding: computes the symbols of a position (paper section II-A), in O(1) per column and row.
#include "code/basis.hpp"
#include "dotpose/code.hpp"

namespace dotpose {

int delta(CodeVariant code, std::uint32_t p) noexcept {
    unsigned sum = code::kMinDelta;
    for (const code::Secondary& a : code::basis(code)) {
        sum += unsigned{a.weight} * a.digits[a.place_of(p)];
    }
    return static_cast<int>(sum);
}

int roll(CodeVariant code, std::uint32_t p) noexcept {
    // The sum of p differences is 5 p plus a contribution of each sequence. The contribution is the
    // sum over the whole turns of the sequence and over the digits of its last, incomplete turn.
    // The number of whole turns is the number of lines in these turns divided by the length of the
    // sequence. Modulo 63, this division is a multiplication by the inverse.
    const std::uint32_t lines = code::modulo_sections(p) + 4 * kSections;
    std::uint32_t sum = code::kMinDelta * lines;
    for (const code::Secondary& a : code::basis(code)) {
        const std::uint32_t place = a.place_of(p);
        sum += (lines - place) * a.turn_roll + a.rolls[place];
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

/// Position and sections of a place along one axis. `own` is the section of the lines of this axis,
/// `cross` the section of the lines of the other axis.
struct AxisPlace {
    std::uint32_t position;
    std::uint8_t own;
    std::uint8_t cross;
};

// Not inlined, because it is called twice and its second half is rarely executed.
[[gnu::noinline]] AxisPlace moved(CodeVariant code, AxisPlace place, std::int32_t distance) {
    const std::int64_t target = std::int64_t{place.position} + distance;
    const bool is_before = target < 0;
    if (!is_before && target < kPositionsPerAxis) {
        place.position = static_cast<std::uint32_t>(target);
        return place;
    }
    // A whole turn along x adds the roll of one turn to the columns. After the turn, the bits of
    // the rows are read at an x that is larger by the length of a turn.
    const auto shifted = [&](int section, int by) {
        const int sum = section + (is_before ? kSections - by : by);
        return static_cast<std::uint8_t>(sum % kSections);
    };
    place.own = shifted(place.own, roll(code, kPositionsPerAxis));
    place.cross = shifted(place.cross, kPositionsPerAxis % kSections);
    const std::int64_t turn = kPositionsPerAxis;
    place.position = static_cast<std::uint32_t>(is_before ? target + turn : target - turn);
    return place;
}

}  // namespace

Place moved(CodeVariant code, Place place, std::int32_t dx, std::int32_t dy) noexcept {
    const AxisPlace x = moved(code, {place.cell.x, place.section.u, place.section.v}, dx);
    const AxisPlace y = moved(code, {place.cell.y, x.cross, x.own}, dy);
    return {{x.position, y.position}, {y.cross, y.own}};
}

}  // namespace dotpose
