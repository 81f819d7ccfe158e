#include "core/decode/search.hpp"

#include <array>

#include "code/rolls.hpp"
#include "core/decode/correlation.hpp"

namespace dotpose::core {
namespace {

constexpr int kChoices = 8;  // offsets tried in one line
constexpr int kMaxRunLength = 8;

/// The offsets of one line that agree best, best first and of equals the smallest: found as they
/// are asked for, which is rarely beyond the first.
class Choices {
  public:
    Choices() = default;
    explicit Choices(const LineScores& scores) : scores_(&scores) {}

    /// `i` is less than kChoices, and at most one more than it was in any call before.
    const Match& operator[](int i) {
        if (i == known_) matches_[static_cast<std::size_t>(known_++)] = next();
        return matches_[static_cast<std::size_t>(i)];
    }

  private:
    Match next() const {
        if (known_ == 0) return best_match(*scores_);
        const Match last = matches_[static_cast<std::size_t>(known_ - 1)];
        Match best{INT16_MIN, 0};
        for (std::size_t o = 0; o < scores_->size(); ++o) {
            const int score = (*scores_)[o];
            if (score > last.score || score <= best.score) continue;
            if (score < last.score || o > last.roll) best = {score, static_cast<std::uint8_t>(o)};
        }
        return best;
    }

    const LineScores* scores_ = nullptr;
    int known_ = 0;
    std::array<Match, kChoices> matches_;
};

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

using Run = std::array<Choices, kMaxRunLength>;

/// How many choices of each line of a run are combined: the next-cheapest choice of any line is
/// added as long as the combinations stay few.
std::array<int, kMaxRunLength> widen(Run& run, int length, int most_readings) {
    std::array<int, kMaxRunLength> widths;
    widths.fill(1);
    for (int readings = 1;;) {
        int cheapest = -1;
        int least_loss = INT32_MAX;
        for (int i = 0; i < length; ++i) {
            const auto n = static_cast<std::size_t>(i);
            const int width = widths[n];
            if (width == kChoices || readings / width * (width + 1) > most_readings) continue;
            const int loss = run[n][0].score - run[n][width].score;
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

/// Reads the lines from `first` on at these rolls, and keeps what is better than the best so far.
/// Returns whether that is clear.
bool improve(Profile profile, const Lines& lines, int first, std::span<const std::uint8_t> rolls,
             AxisReading& best) {
    std::uint32_t position = 0;
    if (position_from_rolls(profile, rolls, position) != Status::ok) return false;
    AxisReading reading = evaluate(profile, lines, first, position, rolls[0]);
    if (reading.score <= best.score) return false;
    reading.most_possible = best.most_possible;
    best = reading;
    return best.is_clear();
}

/// Reads one run in all combinations of its lines' choices, until one is clear.
void try_run(Profile profile, const Lines& lines, int first, int length, int most_readings,
             AxisReading& best) {
    Run run;
    std::array<std::uint8_t, kMaxRunLength> storage;
    const auto rolls = std::span(storage).first(static_cast<std::size_t>(length));
    for (std::size_t n = 0; n < rolls.size(); ++n) {
        run[n] = Choices(lines[first + static_cast<int>(n)]);
        rolls[n] = run[n][0].roll;
    }
    if (improve(profile, lines, first, rolls, best)) return;
    const auto widths = widen(run, length, most_readings);
    std::array<int, kMaxRunLength> choice{};
    while (true) {
        // Counts up, the last line fastest.
        std::size_t n = rolls.size();
        while (n > 0 && choice[n - 1] + 1 == widths[n - 1]) {
            choice[--n] = 0;
            rolls[n] = run[n][0].roll;
        }
        if (n-- == 0) return;
        rolls[n] = run[n][++choice[n]].roll;
        if (improve(profile, lines, first, rolls, best)) return;
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
    best = {0, 0, INT32_MIN, most_possible};
    std::array<bool, kMaxLines> taken{};
    for (int run = 0; run < limits.runs; ++run) {
        const int first = clearest_run(leads, lines.count(), length, taken);
        if (first < 0) break;
        taken[static_cast<std::size_t>(first)] = true;
        try_run(profile, lines, first, length, limits.readings, best);
        if (best.is_clear()) break;
    }
    return best.score == INT32_MIN ? Status::not_in_code : Status::ok;
}

}  // namespace dotpose::core
