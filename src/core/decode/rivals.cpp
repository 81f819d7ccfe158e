#include "core/decode/rivals.hpp"

#include <array>
#include <cmath>

#include "core/decode/contest.hpp"
#include "core/decode/double_rivals.hpp"
#include "core/decode/expected_rivals.hpp"
#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

/// Consecutive lines that distinct positions can share: one more, and five differences are equal.
constexpr int kMostOfDistinct = code::kOrder;
/// Odds at which a closer look at the rivals cannot help.
constexpr float kBeyondHelp = 1e-4F;

/// Turns of the shortest sequence that are as long as all lines.
constexpr std::uint32_t kTurns = kMaxLines / code::kA3.size() + 1;

using Places = std::array<std::uint32_t, 4>;

/// Contest::loss, looked up: rivals that are looked at one by one ask for it a million times.
class Losses {
  public:
    explicit Losses(const Contest& contest) {
        for (int line = 0; line < contest.count(); ++line) {
            auto& losses = losses_[static_cast<std::size_t>(line)];
            for (int shift = 0; shift < kSections; ++shift) {
                const auto i = static_cast<std::size_t>(shift);
                losses[i] = losses[i + kSections] =
                    static_cast<std::int16_t>(contest.loss(line, shift));
            }
        }
    }
    int operator()(int line, int shift) const {
        return losses_[static_cast<std::size_t>(line)][static_cast<std::size_t>(shift + kSections)];
    }

  private:
    std::array<std::array<std::int16_t, 2 * kSections>, kMaxLines> losses_;
};

/// Rivals whose place differs in several sequences and that share fewer lines in a row.
float sum_of_far_rivals(const Contest& contest, int shared_lines, int fewest_different) {
    ExpectedRivals expected(contest.basis, contest.position, shared_lines - 1, fewest_different);
    std::array<float, kSections> line_odds;
    for (int line = 0; line < contest.count(); ++line) {
        for (int shift = 0; shift < kSections; ++shift) {
            line_odds[static_cast<std::size_t>(shift)] = contest.odds(contest.loss(line, shift));
        }
        expected.add_line(line_odds);
    }
    return expected.sum();
}

/// Rivals whose place differs in one sequence only: one by one, with every shift at which they
/// share some line with the reading.
float sum_of_single_rivals(const Contest& contest, const Losses& losses) {
    float sum = 0;
    Growth growth;
    for (std::size_t k = 0; k < contest.basis.size(); ++k) {
        for (std::uint32_t rival = 0; rival < contest.basis[k].length; ++rival) {
            if (rival == contest.places[k]) continue;
            grow(contest, k, rival, growth);
            for (int shared = 0; shared < contest.count(); ++shared) {
                const std::optional<int> lost = loss_of_growth(contest, growth, shared, losses);
                if (lost) sum += contest.odds(*lost);
            }
        }
    }
    return sum;
}

/// The same position in other sections: all lines differ, by the same shift.
float sum_of_other_sections(const Contest& contest) {
    float sum = 0;
    for (int shift = 1; shift < kSections; ++shift) {
        int lost = 0;
        for (int line = 0; line < contest.count(); ++line)
            lost += contest.loss(line, shift);
        sum += contest.odds(lost);
    }
    return sum;
}

/// Sum of the rolls that the sequences add up to a line, from their places at the first line on.
int roll_at(const Contest& contest, const Places& places, int line) {
    int sum = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
        sum += contest.basis[k].rolls[places[k] + static_cast<std::uint32_t>(line)];
    return sum;
}

/// Those of the reading.
using OwnRolls = std::array<int, kMaxLines>;
OwnRolls own_rolls(const Contest& contest) {
    OwnRolls rolls;
    for (int line = 0; line < contest.count(); ++line)
        rolls[static_cast<std::size_t>(line)] = roll_at(contest, contest.places, line);
    return rolls;
}

/// Odds of a rival that shares `shared_lines` lines from `run` on; places are those at the first
/// line.
float odds_of_twin(const Contest& contest, const Losses& losses, const OwnRolls& own,
                   const Places& rival, int run, int shared_lines) {
    const auto growth = [&](int line) {
        return roll_at(contest, rival, line) - own[static_cast<std::size_t>(line)];
    };
    // Positive.
    const int base = growth(run) - 8 * kSections;
    int lost = 0;
    const auto is_hopeless_with = [&](int line) {
        const auto shift =
            code::few_modulo_sections(static_cast<std::uint32_t>(growth(line) - base));
        lost += losses(line, static_cast<int>(shift));
        return contest.is_hopeless(lost);
    };
    for (int line = run + shared_lines; line < contest.count(); ++line) {
        if (is_hopeless_with(line)) return kNegligible;
    }
    for (int line = run - 1; line >= 0; --line) {
        if (is_hopeless_with(line)) return kNegligible;
    }
    return contest.odds(lost);
}

/// Rivals that share that many consecutive lines, four or five, or more: one by one, from the
/// places in the secondary sequences at which the digits of the three or four differences stand
/// again.
float sum_of_near_rivals(const Contest& contest, const Losses& losses, const code::Twins& twins,
                         int shared_lines) {
    const auto order = static_cast<std::size_t>(shared_lines - 4);
    const OwnRolls own_by_line = own_rolls(contest);
    float sum = 0;
    for (int run = 0; run + shared_lines <= contest.count(); ++run) {
        Places own;  // at the run
        for (std::size_t k = 0; k < own.size(); ++k) {
            own[k] =
                (contest.places[k] + static_cast<std::uint32_t>(run)) % contest.basis[k].length;
        }
        Places rival = own;
        Places first = contest.places;
        for (std::size_t k = 0; k < own.size();) {
            for (k = 0; k < own.size(); ++k) {
                const std::uint32_t length = contest.basis[k].length;
                rival[k] = twins[k][order][rival[k]];
                first[k] = (rival[k] + kTurns * length - static_cast<std::uint32_t>(run)) % length;
                if (rival[k] != own[k]) break;
            }
            if (k < own.size())
                sum += odds_of_twin(contest, losses, own_by_line, first, run, shared_lines);
        }
    }
    return sum;
}

}  // namespace

int rivals_log2(Profile profile, const Contest& contest, int limit_log2) {
    if (contest.count() <= kMostOfDistinct) return 0;
    const code::Twins& twins = code::twins(profile);
    const Losses losses(contest);
    const float known = sum_of_single_rivals(contest, losses) + sum_of_other_sections(contest) +
                        sum_of_near_rivals(contest, losses, twins, kMostOfDistinct);
    const float expected = sum_of_far_rivals(contest, kMostOfDistinct, 2);
    float sum = known + expected;
    const float limit = std::ldexp(1.0F, limit_log2);
    const float far_below_doubt = std::ldexp(1.0F, std::min(limit_log2, -30) - 10);
    // The more rivals are looked at one by one, the fewer remain to be feared for their number.
    if (sum > far_below_doubt && expected > known && expected < kBeyondHelp) {
        sum = known + sum_of_near_rivals(contest, losses, twins, kMostOfDistinct - 1) +
              sum_of_far_rivals(contest, kMostOfDistinct - 1, 3);
        if (sum < limit) sum += sum_of_double_rivals(contest);
    }
    int exponent = 0;
    std::frexp(sum, &exponent);  // sum < 2^exponent
    return std::min(exponent, 0);
}

}  // namespace dotpose::core
