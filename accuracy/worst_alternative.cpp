// Finds the wrong position that shares the most lines with a given true position.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "code/basis.hpp"
#include "code/rolls.hpp"
#include "tracked.hpp"

namespace dotpose::tables {
namespace {

/// A place in the code, described relative to one axis: `position` and `section` refer to this
/// axis, and `cross` and `cross_section` to the perpendicular axis.
struct Along {
    std::uint32_t position;
    std::uint8_t section;
    std::uint32_t cross;
    std::uint8_t cross_section;
};

using Places = std::array<std::uint32_t, 4>;

/// Compares the rolls of `lines` consecutive lines at two positions in a secondary sequence.
/// Returns the largest number of lines whose rolls differ by the same amount. These lines are
/// shared, because another section can compensate for a constant difference.
int shared_lines(const code::Secondary& sequence, std::uint32_t place, std::uint32_t other,
                 int lines) {
    std::array<int, kSections> counts{};
    for (int line = 0; line < lines; ++line) {
        const int roll = sequence.rolls[place + static_cast<std::uint32_t>(line)];
        const int there = sequence.rolls[other + static_cast<std::uint32_t>(line)];
        ++counts[static_cast<std::size_t>((there - roll + kSections) % kSections)];
    }
    return *std::ranges::max_element(counts);
}

Places worst_places(const code::Basis& basis, const Places& places, int lines) {
    Places worst = places;
    int most = -1;
    for (std::size_t k = 0; k < places.size(); ++k) {
        for (std::uint32_t other = 0; other < basis[k].length; ++other) {
            if (other == places[k]) continue;
            const int shared = shared_lines(basis[k], places[k], other, lines);
            if (shared <= most) continue;
            most = shared;
            worst = places;
            worst[k] = other;
        }
    }
    return worst;
}

std::uint8_t section_of(int value) {
    return static_cast<std::uint8_t>((value % kSections + kSections) % kSections);
}

/// Returns the section in which the lines starting at `position` match as many of the given rolls
/// as possible.
std::uint8_t likest_section(CodeVariant code, std::uint32_t position, std::uint32_t cross,
                            const std::vector<std::uint8_t>& rolls) {
    std::vector<std::uint8_t> there(rolls.size());
    code::follow_rolls(code, position, code::roll_from(code, position, 0, cross), there);
    std::array<int, kSections> counts{};
    for (std::size_t i = 0; i < rolls.size(); ++i)
        ++counts[section_of(rolls[i] - there[i])];
    return static_cast<std::uint8_t>(std::ranges::max_element(counts) - counts.begin());
}

Along worst(CodeVariant code, const Along& true_place, int lines) {
    const code::Basis& basis = code::basis(code);
    Places places{};
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = basis[k].place_of(true_place.position);
    std::vector<std::uint8_t> rolls(static_cast<std::size_t>(lines));
    code::follow_rolls(
        code, true_place.position,
        code::roll_from(code, true_place.position, true_place.section, true_place.cross), rolls);
    Along alternative = true_place;
    alternative.position = code::position_at(basis, worst_places(basis, places, lines));
    alternative.section = likest_section(code, alternative.position, alternative.cross, rolls);
    // The rolls of the perpendicular lines depend on `position` modulo 63 and on `cross_section`.
    // A new `cross_section` compensates for the new position.
    const auto residue = [](std::uint32_t position) {
        return static_cast<int>(position % static_cast<std::uint32_t>(kSections));
    };
    alternative.cross_section = section_of(true_place.cross_section + residue(true_place.position) -
                                           residue(alternative.position));
    return alternative;
}

}  // namespace

Place worst_alternative(CodeVariant code, const Place& place, bool is_along_x, int lines) {
    const auto& [cell, in] = place;
    if (is_along_x) {
        const Along alternative = worst(code, {cell.x, in.u, cell.y, in.v}, lines);
        return {{alternative.position, alternative.cross},
                {alternative.section, alternative.cross_section}};
    }
    const Along alternative = worst(code, {cell.y, in.v, cell.x, in.u}, lines);
    return {{alternative.cross, alternative.position},
            {alternative.cross_section, alternative.section}};
}

}  // namespace dotpose::tables
