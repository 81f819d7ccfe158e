#include "core/decode/search.hpp"

#include <array>

#include "code/rolls.hpp"
#include "core/decode/correlation.hpp"
#include "core/decode/step_search.hpp"
#include "core/decode/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::search;

constexpr int kChoices = tuned::kChoices;
constexpr int kMaxRunLength = 8;

/// Returns the smallest roll with the given score, which must be in `scores`.
std::uint8_t roll_of(int score, const LineScores& scores) {
    const std::int16_t* found = scores.data();
    while (*found != score)
        ++found;
    return static_cast<std::uint8_t>(found - scores.data());
}

/// The rolls of one line, in order of decreasing score. Ties are broken by taking the smaller roll.
/// All rolls after the first are computed on demand, because most searches do not need them.
class Choices {
  public:
    Choices() = default;
    explicit Choices(const ScoredLine& line)
        : scores_(&line.scores),
          margin_(line.best.margin),
          last_(roll_of(line.best.score, line.scores)),
          rolls_{last_} {}

    /// Returns the roll of rank `i`, for i < kChoices. Rank 0 has the highest score.
    std::uint8_t roll(int i) {
        for (; known_ <= i; ++known_) {
            last_ = next_match(*scores_, {(*scores_)[last_], last_}).roll;
            rolls_[static_cast<std::size_t>(known_)] = last_;
        }
        return rolls_[static_cast<std::size_t>(i)];
    }
    /// Returns the score of rank 0 minus the score of rank `i`.
    int loss(int i) { return i == 1 ? margin_ : (*scores_)[rolls_[0]] - (*scores_)[roll(i)]; }

  private:
    const LineScores* scores_ = nullptr;
    int margin_ = 0;
    int known_ = 1;
    std::uint8_t last_ = 0;
    std::array<std::uint8_t, kChoices> rolls_;
};

/// Returns the reading of all lines, given the position and roll of line `line`. The score of the
/// reading is the total over all lines.
AxisReading evaluate(CodeVariant code, const Lines& lines, int line, std::uint32_t position,
                     int roll) {
    std::array<std::uint8_t, kMaxLines> storage;
    const auto rolls = std::span(storage).first(lines.all.size());
    AxisReading reading = reading_of_first(code, position, roll, line, rolls);
    for (int i = 0; i < lines.count(); ++i) {
        const int here = reading.roll + rolls[static_cast<std::size_t>(i)];
        reading.score +=
            lines[i][static_cast<std::size_t>(here < kSections ? here : here - kSections)];
    }
    return reading;
}

using Run = std::array<Choices, kMaxRunLength>;

/// Chooses the number of rolls to try for each line of a run. Repeatedly adds the roll with the
/// smallest loss among those that keep the number of combinations within `max_readings`.
std::array<int, kMaxRunLength> widen(Run& run, int length, int max_readings) {
    std::array<int, kMaxRunLength> widths;
    widths.fill(1);
    for (int readings = 1;;) {
        int cheapest = -1;
        int min_loss = INT32_MAX;
        for (int i = 0; i < length; ++i) {
            const auto n = static_cast<std::size_t>(i);
            const int width = widths[n];
            if (width == kChoices || readings * (width + 1) > max_readings * width) continue;
            const int loss = run[n].loss(width);
            if (loss < min_loss) {
                min_loss = loss;
                cheapest = i;
            }
        }
        if (cheapest < 0) return widths;
        int& width = widths[static_cast<std::size_t>(cheapest)];
        readings = readings / width * (width + 1);
        ++width;
    }
}

/// Decodes the position from the rolls of adjacent lines, starting at line `first`. If the reading
/// at this position has a higher total score than `best`, replaces `best` with it. Returns true if
/// the new `best` is clear.
bool improve(CodeVariant code, const Lines& lines, int first, std::span<const std::uint8_t> rolls,
             AxisReading& best) {
    std::uint32_t position = 0;
    if (position_from_rolls(code, rolls, position) != Status::ok) return false;
    AxisReading reading = evaluate(code, lines, first, position, rolls[0]);
    if (reading.score <= best.score) return false;
    reading.max_possible = best.max_possible;
    best = reading;
    return best.is_clear();
}

/// Tries up to `max_readings` combinations of the most likely rolls in one run. Stops at the first
/// clear reading.
void try_run(CodeVariant code, const Lines& lines, int first, int length, int max_readings,
             AxisReading& best) {
    Run run;
    std::array<std::uint8_t, kMaxRunLength> storage;
    const auto rolls = std::span(storage).first(static_cast<std::size_t>(length));
    for (std::size_t n = 0; n < rolls.size(); ++n) {
        run[n] = Choices(lines.all[n + static_cast<std::size_t>(first)]);
        rolls[n] = run[n].roll(0);
    }
    if (improve(code, lines, first, rolls, best)) return;
    const auto widths = widen(run, length, max_readings);
    std::array<int, kMaxRunLength> choice{};
    while (true) {
        // Advances to the next combination. The roll of the last line varies fastest.
        std::size_t n = rolls.size();
        while (n > 0 && choice[n - 1] + 1 == widths[n - 1]) {
            choice[--n] = 0;
            rolls[n] = run[n].roll(0);
        }
        if (n-- == 0) return;
        rolls[n] = run[n].roll(++choice[n]);
        if (improve(code, lines, first, rolls, best)) return;
    }
}

/// Returns the first line of the clearest run of `length` lines, or -1 if there is no run. The
/// clearest run has the largest sum of margins (`BestScore::margin`). Skips runs whose first line
/// is marked in `taken`.
int clearest_run(const Lines& lines, int length, const std::array<bool, kMaxLines>& taken) {
    int clearest = -1;
    int largest = INT32_MIN;
    int margin = 0;
    for (int end = 0; end < lines.count(); ++end) {
        margin += lines.best(end).margin;
        const int first = end + 1 - length;
        if (first < 0) continue;
        if (margin > largest && !taken[static_cast<std::size_t>(first)]) {
            largest = margin;
            clearest = first;
        }
        margin -= lines.best(first).margin;
    }
    return clearest;
}

struct Limits {
    int runs;
    int readings;  ///< maximum number of readings per run
};

/// Reads up to `limits.runs` runs of lines, clearest run first. Stops when a reading is clear.
void search_by_runs(CodeVariant code, const Lines& lines, const Limits& limits, AxisReading& best) {
    const int length = run_length(code);
    std::int32_t max_possible = 0;
    for (int i = 0; i < lines.count(); ++i)
        max_possible += lines.best(i).score;
    best = {0, 0, INT32_MIN, max_possible};
    std::array<bool, kMaxLines> taken{};
    for (int run = 0; run < limits.runs; ++run) {
        const int first = clearest_run(lines, length, taken);
        if (first < 0) break;
        taken[static_cast<std::size_t>(first)] = true;
        try_run(code, lines, first, length, limits.readings, best);
        if (best.is_clear()) break;
    }
}

Status status_of(const AxisReading& best) {
    return best.score == INT32_MIN ? Status::not_in_code : Status::ok;
}

}  // namespace

int run_length(CodeVariant code) {
    return code == CodeVariant::libdots ? 8 : 6;
}

AxisReading reading_of_first(CodeVariant code, std::uint32_t position, int roll, int line,
                             std::span<std::uint8_t> rolls) {
    const auto before = static_cast<std::uint32_t>(line);
    AxisReading reading;
    reading.position =
        position >= before ? position - before : position + kPositionsPerAxis - before;
    code::follow_rolls(code, reading.position, 0, rolls);
    const int there = rolls[before];
    reading.roll = static_cast<std::uint8_t>(roll - there + (roll < there ? kSections : 0));
    return reading;
}

Status find_axis(CodeVariant code, const Lines& lines, AxisReading& best) {
    search_by_runs(code, lines, {tuned::kRuns, tuned::kReadings}, best);
    if (best.score < best.max_possible && lines.count() >= run_length(code)) {
        search_by_steps(code, lines, best);
    }
    return status_of(best);
}

Status find_axis_briefly(CodeVariant code, const Lines& lines, AxisReading& best) {
    search_by_runs(code, lines, {tuned::kRunsBriefly, tuned::kReadingsBriefly}, best);
    return status_of(best);
}

}  // namespace dotpose::core
