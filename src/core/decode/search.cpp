#include "core/decode/search.hpp"

#include <array>

#include "code/rolls.hpp"

namespace dotpose::core {
namespace {

constexpr int kChoices = 8;  // offsets tried in one line
constexpr int kMaxRunLength = 8;

/// The offsets of one line that agree best, best first.
struct Choices {
    std::array<std::uint8_t, kChoices> rolls{};
    std::array<std::int16_t, kChoices> scores{};
};

Choices best_choices(const LineScores& scores) {
    Choices choices;
    choices.scores.fill(INT16_MIN);
    for (std::size_t o = 0; o < scores.size(); ++o) {
        const std::int16_t score = scores[o];
        if (score <= choices.scores[kChoices - 1]) continue;
        std::size_t i = kChoices - 1;
        for (; i > 0 && score > choices.scores[i - 1]; --i) {
            choices.scores[i] = choices.scores[i - 1];
            choices.rolls[i] = choices.rolls[i - 1];
        }
        choices.scores[i] = score;
        choices.rolls[i] = static_cast<std::uint8_t>(o);
    }
    return choices;
}

/// By how much the best offset of a line leads the second best, and its score.
struct Lead {
    std::int16_t best = INT16_MIN;
    std::int16_t lead = 0;
};

Lead lead_of(const LineScores& scores) {
    std::int16_t best = INT16_MIN;
    std::int16_t second = INT16_MIN;
    for (const std::int16_t score : scores) {
        if (score <= second) continue;
        second = std::min(best, score);
        best = std::max(best, score);
    }
    return {best, static_cast<std::int16_t>(best - second)};
}

/// Sum over all lines for the hypothesis that line `line` stands at `position` with `roll`.
AxisReading evaluate(Profile profile, const Lines& lines, int line, std::uint32_t position,
                     int roll) {
    const auto before = static_cast<std::uint32_t>(line);
    AxisReading reading;
    reading.position =
        position >= before ? position - before : position + kPositionsPerAxis - before;
    std::array<std::uint8_t, kMaxLines> rolls;
    code::follow_rolls(profile, reading.position, 0, std::span(rolls).first(lines.scores.size()));
    const int first_roll = roll - rolls[before] + (roll < rolls[before] ? kSections : 0);
    reading.roll = static_cast<std::uint8_t>(first_roll);
    for (int i = 0; i < lines.count(); ++i) {
        const int here = first_roll + rolls[static_cast<std::size_t>(i)];
        reading.score +=
            lines[i][static_cast<std::size_t>(here < kSections ? here : here - kSections)];
    }
    return reading;
}

/// How many choices of each line of a run are combined: the next-cheapest choice of any line is
/// added as long as the combinations stay few.
std::array<int, kMaxRunLength> widen(const Choices* run, int length, int most_readings) {
    std::array<int, kMaxRunLength> widths;
    widths.fill(1);
    for (int readings = 1;;) {
        int cheapest = -1;
        int least_loss = INT32_MAX;
        for (int i = 0; i < length; ++i) {
            const int width = widths[static_cast<std::size_t>(i)];
            if (width == kChoices || readings / width * (width + 1) > most_readings) continue;
            const int loss = run[i].scores[0] - run[i].scores[static_cast<std::size_t>(width)];
            if (loss < least_loss) {
                least_loss = loss;
                cheapest = i;
            }
        }
        if (cheapest < 0) return widths;
        int& width = widths[static_cast<std::size_t>(cheapest)];
        readings = readings / width * (width + 1);
        ++width;
    }
}

/// Reads one run in all combinations of its lines' choices, until one is clear.
void try_run(Profile profile, const Lines& lines, int first, int length, int most_readings,
             std::int32_t most_possible, AxisReading& best) {
    std::array<Choices, kMaxRunLength> storage;
    for (int i = 0; i < length; ++i)
        storage[static_cast<std::size_t>(i)] = best_choices(lines[first + i]);
    const Choices* run = storage.data();
    const auto widths = widen(run, length, most_readings);
    std::array<int, kMaxRunLength> choice{};
    std::array<std::uint8_t, kMaxRunLength> rolls{};
    for (int digit = 0; digit < length;) {
        for (int i = 0; i < length; ++i) {
            const auto n = static_cast<std::size_t>(i);
            rolls[n] = run[i].rolls[static_cast<std::size_t>(choice[n])];
        }
        std::uint32_t position = 0;
        const auto used =
            std::span<const std::uint8_t>(rolls).first(static_cast<std::size_t>(length));
        if (position_from_rolls(profile, used, position) == Status::ok) {
            const AxisReading reading = evaluate(profile, lines, first, position, rolls[0]);
            if (reading.score > best.score) {
                best = reading;
                best.most_possible = most_possible;
                if (best.is_clear()) return;
            }
        }
        // Counts up, the last line fastest.
        for (digit = 0; digit < length; ++digit) {
            const auto n = static_cast<std::size_t>(length - 1 - digit);
            if (++choice[n] < widths[n]) break;
            choice[n] = 0;
        }
    }
}

/// Start of the clearest run not taken yet, or -1: that whose lines lead their runners-up by most.
int clearest_run(const std::array<Lead, kMaxLines>& leads, int lines, int length,
                 const std::array<bool, kMaxLines>& taken) {
    int clearest = -1;
    int most = INT32_MIN;
    for (int first = 0; first + length <= lines; ++first) {
        if (taken[static_cast<std::size_t>(first)]) continue;
        int lead = 0;
        for (int i = first; i < first + length; ++i)
            lead += leads[static_cast<std::size_t>(i)].lead;
        if (lead > most) {
            most = lead;
            clearest = first;
        }
    }
    return clearest;
}

}  // namespace

Status find_axis(Profile profile, const Lines& lines, AxisReading& best, SearchLimits limits) {
    // The misprinted sequence tells positions apart only by 7 differences.
    const int length = profile == Profile::published ? 8 : 6;
    std::array<Lead, kMaxLines> leads;
    std::int32_t most_possible = 0;
    for (int i = 0; i < lines.count(); ++i) {
        const Lead lead = lead_of(lines[i]);
        leads[static_cast<std::size_t>(i)] = lead;
        most_possible += lead.best;
    }
    best = {0, 0, INT32_MIN, 0};
    std::array<bool, kMaxLines> taken{};
    for (int run = 0; run < limits.runs; ++run) {
        const int first = clearest_run(leads, lines.count(), length, taken);
        if (first < 0) break;
        taken[static_cast<std::size_t>(first)] = true;
        try_run(profile, lines, first, length, limits.readings, most_possible, best);
        if (best.is_clear()) break;
    }
    return best.score == INT32_MIN ? Status::not_in_code : Status::ok;
}

}  // namespace dotpose::core
