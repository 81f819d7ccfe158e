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
constexpr int kMostShared = code::kOrder;
/// Odds at which a closer look at the rivals changes nothing any more, or cannot help.
constexpr float kFarBelowDoubt = 1e-12F;
constexpr float kBeyondHelp = 1e-4F;
static_assert(4 * code::kA3.size() >= kMaxLines, "steps back from any line stay positive");

using Places = std::array<std::uint32_t, 4>;

/// Rivals whose place differs in several sequences and that share fewer lines in a row.
float sum_of_far_rivals(const Contest& contest, int shared_lines, int fewest_different) {
    ExpectedRivals expected(contest.basis, contest.position, shared_lines - 1, fewest_different);
    std::array<float, kSections> line_odds;
    for (int line = 0; line < contest.lines.count(); ++line) {
        for (int shift = 0; shift < kSections; ++shift) {
            line_odds[static_cast<std::size_t>(shift)] = contest.odds(contest.loss(line, shift));
        }
        expected.add_line(line_odds);
    }
    return expected.sum();
}

/// Rivals whose place differs in one sequence only: one by one, with every shift at which they
/// share some line with the reading.
float sum_of_single_rivals(const Contest& contest) {
    float sum = 0;
    Growth growth;
    for (std::size_t k = 0; k < contest.basis.size(); ++k) {
        for (std::uint32_t rival = 0; rival < contest.basis[k].length; ++rival) {
            if (rival == contest.places[k]) continue;
            grow(contest, k, rival, growth);
            for (int shared = 0; shared < contest.lines.count(); ++shared) {
                const std::optional<int> lost = loss_of_growth(contest, growth, shared);
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
        for (int line = 0; line < contest.lines.count(); ++line)
            lost += contest.loss(line, shift);
        sum += contest.odds(lost);
    }
    return sum;
}

/// By how much more a rival's roll grows than the reading's from `step` lines after a shared run's
/// beginning to the next line.
int difference(const Contest& contest, const Places& own, const Places& rival, int step) {
    int sum = 0;
    for (std::size_t k = 0; k < contest.basis.size(); ++k) {
        const code::Secondary& a = contest.basis[k];
        const auto at = [&](std::uint32_t place) {
            // The shortest sequence, four times over, is longer than any line count.
            const std::uint32_t ahead = place + 4U * a.length + static_cast<std::uint32_t>(step);
            return int{a.digits[ahead % a.length]};
        };
        if (own[k] != rival[k]) sum += a.weight * (at(rival[k]) - at(own[k]));
    }
    return sum;
}

/// Odds of a rival that shares `shared_lines` lines from `run` on.
float odds_of_twin(const Contest& contest, const Places& own, const Places& rival, int run,
                   int shared_lines) {
    int lost = 0;
    int shift = 0;
    for (int line = run + shared_lines; line < contest.lines.count(); ++line) {
        shift = (shift + difference(contest, own, rival, line - 1 - run)) % kSections;
        lost += contest.loss(line, shift);
        if (contest.is_hopeless(lost)) return kNegligible;
    }
    shift = 0;
    for (int line = run - 1; line >= 0; --line) {
        shift = (shift - difference(contest, own, rival, line - run)) % kSections;
        lost += contest.loss(line, shift);
        if (contest.is_hopeless(lost)) return kNegligible;
    }
    return contest.odds(lost);
}

/// Rivals that share that many consecutive lines, four or five, or more: one by one, from the
/// places in the secondary sequences at which the digits of the three or four differences stand
/// again.
float sum_of_near_rivals(const Contest& contest, const code::Twins& twins, int shared_lines) {
    const auto order = static_cast<std::size_t>(shared_lines - 4);
    float sum = 0;
    for (int run = 0; run + shared_lines <= contest.lines.count(); ++run) {
        Places own;
        for (std::size_t k = 0; k < own.size(); ++k) {
            own[k] = (contest.position + static_cast<std::uint32_t>(run)) % contest.basis[k].length;
        }
        Places rival = own;
        for (std::size_t k = 0; k < own.size();) {
            for (k = 0; k < own.size(); ++k) {
                rival[k] = twins[k][order][rival[k]];
                if (rival[k] != own[k]) break;
            }
            if (k < own.size()) sum += odds_of_twin(contest, own, rival, run, shared_lines);
        }
    }
    return sum;
}

}  // namespace

int rivals_log2(Profile profile, const Lines& lines, const AxisReading& reading,
                int odds_per_bit_q8) {
    if (odds_per_bit_q8 <= 0 || lines.count() <= kMostShared) return 0;
    const Contest contest(profile, lines, reading, odds_per_bit_q8);
    float known = sum_of_single_rivals(contest) + sum_of_other_sections(contest) +
                  sum_of_near_rivals(contest, code::twins(profile), kMostShared);
    float expected = sum_of_far_rivals(contest, kMostShared, 2);
    // The more rivals are looked at one by one, the fewer remain to be feared for their number.
    if (known + expected > kFarBelowDoubt && expected > known && expected < kBeyondHelp) {
        known += sum_of_double_rivals(contest) +
                 sum_of_near_rivals(contest, code::twins(profile), kMostShared - 1);
        expected = sum_of_far_rivals(contest, kMostShared - 1, 3);
    }
    int exponent = 0;
    std::frexp(known + expected, &exponent);  // sum < 2^exponent
    return std::min(exponent, 0);
}

}  // namespace dotpose::core
