#include "locate/other_place.hpp"

#include <algorithm>

#include "code/rolls.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

/// Returns the signed number of steps from one position to another, in the direction with fewer
/// steps. Positions are cyclic.
std::int32_t steps(std::uint32_t from, std::uint32_t to) {
    constexpr auto kAll = static_cast<std::int32_t>(kPositionsPerAxis);
    const std::int32_t step = static_cast<std::int32_t>(to) - static_cast<std::int32_t>(from);
    if (step > kAll / 2) return step - kAll;
    return step < -kAll / 2 ? step + kAll : step;
}

/// Position and roll of a line in one code.
struct Line {
    std::uint32_t position;
    int roll;
};

/// Returns the line at the position that was read, with its roll in the code `other`.
Line here(CodeVariant read, CodeVariant other, std::uint32_t position, int roll_read) {
    return {position, roll_read + roll(other, position) - roll(read, position)};
}

/// Returns the line at the most likely place in the other code, excluding the place that was read.
Line elsewhere(const OtherAxis& axis, int roll_read) {
    return {axis.position, roll_read + axis.roll};
}

std::uint8_t section(CodeVariant code, const Line& line, const Line& crossing) {
    const int roll = (line.roll + 2 * kSections) % kSections;
    return static_cast<std::uint8_t>(section_of(code, roll, line.position, crossing.position));
}

/// Returns the likelihood of the most likely place that differs from the fix along at least one
/// axis, divided by the likelihood of the fix.
float best_odds(const OtherCode& there) {
    return std::max(
        {there.x.best * there.y.here, there.x.here * there.y.best, there.x.best * there.y.best});
}

}  // namespace

void name_code_that_explains(const OtherCodes& others, CodeReading& reading) {
    float max_odds = 0;
    for (std::size_t i = 0; i < others.of.size(); ++i) {
        const auto other = static_cast<CodeVariant>(i);
        if (other == reading.code) continue;
        const float elsewhere = best_odds(others.of[i]);
        const float here = others.of[i].here();
        const bool is_here = here > tuning::cascade::kNamedHere && here > elsewhere;
        if ((!is_here && elsewhere < tuning::cascade::kNamedElsewhere) ||
            std::max(here, elsewhere) <= max_odds)
            continue;
        max_odds = std::max(here, elsewhere);
        if (!is_here) {
            name_other_place(reading.code, other, others, reading);
            continue;
        }
        reading.has_other = true;
        reading.other_code = other;
        reading.other_cell = reading.fix.cell;
        reading.other_section = reading.fix.section;
    }
}

void name_other_place(CodeVariant read, CodeVariant other, const OtherCodes& others,
                      CodeReading& reading) {
    const Fix& fix = reading.fix;
    const OtherCode& there = others.of[static_cast<std::size_t>(other)];
    const Place first = moved(read, fix.place, steps(fix.place.cell.x, others.first.x),
                              steps(fix.place.cell.y, others.first.y));
    const int x_roll = code::roll_from(read, first.cell.x, first.section.u, first.cell.y);
    const int y_roll = code::roll_from(read, first.cell.y, first.section.v, first.cell.x);
    // Likelihood ratios of the places that differ from the fix along x, along y, or along both
    // axes.
    const float by_x = there.x.best * there.y.here;
    const float by_y = there.x.here * there.y.best;
    const float by_both = there.x.best * there.y.best;
    const bool is_x = by_x >= by_y || by_both > by_y;
    const bool is_y = by_y > by_x || by_both > by_x;
    const Line x = is_x ? elsewhere(there.x, x_roll) : here(read, other, first.cell.x, x_roll);
    const Line y = is_y ? elsewhere(there.y, y_roll) : here(read, other, first.cell.y, y_roll);
    const Place corner{{x.position, y.position}, {section(other, x, y), section(other, y, x)}};
    const Place place =
        moved(other, corner, steps(first.cell.x, fix.cell.x), steps(first.cell.y, fix.cell.y));
    reading.has_other = true;
    reading.other_code = other;
    reading.other_cell = place.cell;
    reading.other_section = place.section;
}

void note_other_reading(const CodeReading& any, CodeReading& reading) {
    const bool is_read = any.fix.status == Status::ok || any.fix.status == Status::ambiguous_code;
    if (!is_read || tuning::cascade::kMinDotsPerBitError * any.fix.bit_errors > any.fix.dots_seen)
        return;
    const bool is_first = any.code != reading.code;
    reading.has_other = is_first || any.has_other;
    reading.other_code = is_first ? any.code : any.other_code;
    reading.other_cell = is_first ? any.fix.cell : any.other_cell;
    reading.other_section = is_first ? any.fix.section : any.other_section;
}

}  // namespace dotpose::core
