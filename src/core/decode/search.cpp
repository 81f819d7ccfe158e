#include "core/decode/search.hpp"

#include <array>

#include "core/decode/correlation.hpp"

namespace dotpose::core {
namespace {

constexpr int kChoices = 8;       // offsets tried in one line
constexpr int kMaxReadings = 64;  // of one run
constexpr int kMaxRuns = 24;
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
        std::size_t i = kChoices;
        for (; i > 0 && scores[o] > choices.scores[i - 1]; --i) {
            if (i == kChoices) continue;
            choices.scores[i] = choices.scores[i - 1];
            choices.rolls[i] = choices.rolls[i - 1];
        }
        if (i == kChoices) continue;
        choices.scores[i] = scores[o];
        choices.rolls[i] = static_cast<std::uint8_t>(o);
    }
    return choices;
}

std::uint32_t next(std::uint32_t p) {
    return p + 1 == kPositionsPerAxis ? 0 : p + 1;
}
std::uint32_t previous(std::uint32_t p) {
    return p == 0 ? kPositionsPerAxis - 1 : p - 1;
}

/// Sum over all lines for the hypothesis that line `line` stands at `position` with `roll`.
AxisReading evaluate(Profile profile, const Lines& lines, int line, std::uint32_t position,
                     int roll) {
    AxisReading reading{position, static_cast<std::uint8_t>(roll), 0, 0};
    for (int i = line - 1; i >= 0; --i) {
        reading.position = previous(reading.position);
        reading.roll = static_cast<std::uint8_t>(
            (reading.roll + kSections - delta(profile, reading.position)) % kSections);
        reading.score += lines[i][reading.roll];
    }
    for (int i = line; i < lines.count(); ++i) {
        reading.score += lines[i][static_cast<std::size_t>(roll)];
        roll = (roll + delta(profile, position)) % kSections;
        position = next(position);
    }
    return reading;
}

/// How many choices of each line of a run are combined: the next-cheapest choice of any line is
/// added as long as the combinations stay few.
std::array<int, kMaxRunLength> widen(const Choices* run, int length) {
    std::array<int, kMaxRunLength> widths;
    widths.fill(1);
    for (int readings = 1;;) {
        int cheapest = -1;
        int least_loss = INT32_MAX;
        for (int i = 0; i < length; ++i) {
            const int width = widths[static_cast<std::size_t>(i)];
            if (width == kChoices || readings / width * (width + 1) > kMaxReadings) continue;
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

/// Reads one run in all combinations of its lines' choices; true if one of them is the best so far.
bool try_run(Profile profile, const Lines& lines, const Choices* run, int first, int length,
             AxisReading& best) {
    const auto widths = widen(run, length);
    std::array<int, kMaxRunLength> choice{};
    std::array<std::uint8_t, kMaxRunLength> rolls{};
    bool found = false;
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
                found = true;
            }
        }
        // Counts up, the last line fastest.
        for (digit = 0; digit < length; ++digit) {
            const auto n = static_cast<std::size_t>(length - 1 - digit);
            if (++choice[n] < widths[n]) break;
            choice[n] = 0;
        }
    }
    return found;
}

/// Start of the clearest run not taken yet, or -1: that whose lines lead their runners-up by most.
int clearest_run(const Choices* choices, int lines, int length,
                 const std::array<bool, kMaxLines>& taken) {
    int clearest = -1;
    int most = INT32_MIN;
    for (int first = 0; first + length <= lines; ++first) {
        if (taken[static_cast<std::size_t>(first)]) continue;
        int lead = 0;
        for (int i = first; i < first + length; ++i) {
            lead += choices[i].scores[0] - choices[i].scores[1];
        }
        if (lead > most) {
            most = lead;
            clearest = first;
        }
    }
    return clearest;
}

}  // namespace

Status find_axis(Profile profile, const Lines& lines, AxisReading& best) {
    // The misprinted sequence tells positions apart only by 7 differences.
    const int length = profile == Profile::published ? 8 : 6;
    std::array<Choices, kMaxLines> choices;
    std::int32_t most_possible = 0;
    for (int i = 0; i < lines.count(); ++i) {
        choices[static_cast<std::size_t>(i)] = best_choices(lines[i]);
        most_possible += choices[static_cast<std::size_t>(i)].scores[0];
    }
    best = {0, 0, INT32_MIN, 0};
    std::array<bool, kMaxLines> taken{};
    for (int run = 0; run < kMaxRuns; ++run) {
        const int first = clearest_run(choices.data(), lines.count(), length, taken);
        if (first < 0) break;
        taken[static_cast<std::size_t>(first)] = true;
        const Choices* run_choices = choices.data() + first;
        if (!try_run(profile, lines, run_choices, first, length, best)) continue;
        best.most_possible = most_possible;
        if (best.is_clear()) {
            break;
        }
    }
    return best.score == INT32_MIN ? Status::not_in_code : Status::ok;
}

}  // namespace dotpose::core
