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

/// The smallest offset with a score that there is.
std::uint8_t roll_of(int score, const LineScores& scores) {
    const std::int16_t* found = scores.data();
    while (*found != score)
        ++found;
    return static_cast<std::uint8_t>(found - scores.data());
}

/// The offsets of one line that agree best, best first and of equals the smallest: found as they
/// are asked for, which is rarely beyond the first.
class Choices {
  public:
    Choices() = default;
    explicit Choices(const ScoredLine& line)
        : scores_(&line.scores),
          margin_(line.best.margin),
          last_(roll_of(line.best.score, line.scores)),
          rolls_{last_} {}

    /// `i` is less than kChoices.
    std::uint8_t roll(int i) {
        for (; known_ <= i; ++known_) {
            last_ = next_match(*scores_, {(*scores_)[last_], last_}).roll;
            rolls_[static_cast<std::size_t>(known_)] = last_;
        }
        return rolls_[static_cast<std::size_t>(i)];
    }
    /// By how much it agrees less than the best.
    int loss(int i) { return i == 1 ? margin_ : (*scores_)[rolls_[0]] - (*scores_)[roll(i)]; }

  private:
    const LineScores* scores_ = nullptr;
    int margin_ = 0;
    int known_ = 1;
    std::uint8_t last_ = 0;
    std::array<std::uint8_t, kChoices> rolls_;
};

/// Sum over all lines for the hypothesis that line `line` stands at `position` with `roll`.
AxisReading evaluate(Profile profile, const Lines& lines, int line, std::uint32_t position,
                     int roll) {
    const auto before = static_cast<std::uint32_t>(line);
    AxisReading reading;
    reading.position =
        position >= before ? position - before : position + kPositionsPerAxis - before;
    std::array<std::uint8_t, kMaxLines> rolls;
    code::follow_rolls(profile, reading.position, 0, std::span(rolls).first(lines.all.size()));
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
            if (width == kChoices || readings * (width + 1) > most_readings * width) continue;
            const int loss = run[n].loss(width);
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
        run[n] = Choices(lines.all[n + static_cast<std::size_t>(first)]);
        rolls[n] = run[n].roll(0);
    }
    if (improve(profile, lines, first, rolls, best)) return;
    const auto widths = widen(run, length, most_readings);
    std::array<int, kMaxRunLength> choice{};
    while (true) {
        // Counts up, the last line fastest.
        std::size_t n = rolls.size();
        while (n > 0 && choice[n - 1] + 1 == widths[n - 1]) {
            choice[--n] = 0;
            rolls[n] = run[n].roll(0);
        }
        if (n-- == 0) return;
        rolls[n] = run[n].roll(++choice[n]);
        if (improve(profile, lines, first, rolls, best)) return;
    }
}

/// Start of the clearest run not taken yet, or -1: the one with the largest sum of margins.
int clearest_run(const Lines& lines, int length, const std::array<bool, kMaxLines>& taken) {
    int clearest = -1;
    int most = INT32_MIN;
    for (int first = 0; first + length <= lines.count(); ++first) {
        if (taken[static_cast<std::size_t>(first)]) continue;
        int margin = 0;
        for (int i = first; i < first + length; ++i)
            margin += lines.best(i).margin;
        if (margin > most) {
            most = margin;
            clearest = first;
        }
    }
    return clearest;
}

/// Lines that carry a position: the misprinted sequence tells positions apart only by 7
/// differences.
int run_length(Profile profile) {
    return profile == Profile::libdots ? 8 : 6;
}

/// How many readings are tried before the best of them is taken.
struct Limits {
    int runs;
    int readings;  ///< of each run
};

/// Reads runs of lines, until one is clear.
void search_by_runs(Profile profile, const Lines& lines, const Limits& limits, AxisReading& best) {
    const int length = run_length(profile);
    std::int32_t most_possible = 0;
    for (int i = 0; i < lines.count(); ++i)
        most_possible += lines.best(i).score;
    best = {0, 0, INT32_MIN, most_possible};
    std::array<bool, kMaxLines> taken{};
    for (int run = 0; run < limits.runs; ++run) {
        const int first = clearest_run(lines, length, taken);
        if (first < 0) break;
        taken[static_cast<std::size_t>(first)] = true;
        try_run(profile, lines, first, length, limits.readings, best);
        if (best.is_clear()) break;
    }
}

Status status_of(const AxisReading& best) {
    return best.score == INT32_MIN ? Status::not_in_code : Status::ok;
}

}  // namespace

Status find_axis(Profile profile, const Lines& lines, AxisReading& best) {
    search_by_runs(profile, lines, {tuned::kRuns, tuned::kReadings}, best);
    if (best.score < best.most_possible && lines.count() >= run_length(profile)) {
        search_by_steps(profile, lines, best);
    }
    return status_of(best);
}

Status find_axis_briefly(Profile profile, const Lines& lines, AxisReading& best) {
    search_by_runs(profile, lines, {tuned::kRunsBriefly, tuned::kReadingsBriefly}, best);
    return status_of(best);
}

}  // namespace dotpose::core
