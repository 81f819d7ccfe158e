#include "core/decode/rivals.hpp"

#include <array>
#include <cmath>

#include "code/basis.hpp"
#include "core/decode/expected_rivals.hpp"
#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

/// Odds below 2^-64 are not followed up, but still counted, at this value.
constexpr int kNegligible_q8 = -64 * 256;
constexpr float kNegligible = 5.5e-20F;
/// Consecutive lines that distinct positions can share: one more, and five differences are equal.
constexpr int kMostShared = code::kOrder;
/// Odds at which a closer look at the rivals changes nothing any more.
constexpr float kFarBelowDoubt = 1e-12F;
static_assert(4 * code::kA3.size() >= kMaxLines, "steps back from any line stay positive");

/// One reading against its rivals.
class Contest {
  public:
    Contest(Profile profile, const Lines& lines, const AxisReading& reading, int odds_q8);

    float sum_of_far_rivals(int shared_lines) const;
    float sum_of_single_rivals() const;
    float sum_of_near_rivals(int shared_lines) const;
    float sum_of_other_sections() const;

  private:
    using Places = std::array<std::uint32_t, 4>;

    /// Score that a rival gives up in a line whose roll it puts `shift` further.
    int loss(int line, int shift) const {
        const int own = rolls_[static_cast<std::size_t>(line)];
        const int other = (own + shift + kSections) % kSections;
        return lines_[line][static_cast<std::size_t>(own)] -
               lines_[line][static_cast<std::size_t>(other)];
    }
    int log2_odds_q8(int lost) const {
        return static_cast<int>(-std::int64_t{lost} * odds_per_bit_q8_ / (2 * 127));
    }
    /// Odds of a rival, against the reading, that has lost so much score.
    float odds(int lost) const {
        const int log2_q8 = std::max(log2_odds_q8(lost), kNegligible_q8);
        const int whole = log2_q8 >> 8;
        return std::ldexp(static_cast<float>(exp2_q16(log2_q8 - whole * 256)), whole - 16);
    }
    bool is_hopeless(int lost) const {
        return log2_odds_q8(lost - most_regained_) < kNegligible_q8;
    }
    float odds_of_growth(const std::array<std::int16_t, kMaxLines>& growth, int shared) const;
    int difference(const Places& own, const Places& rival, int step) const;
    float odds_of(const Places& own, const Places& rival, int run, int shared_lines) const;

    const code::Basis& basis_;
    const Lines& lines_;
    std::uint32_t position_;
    int odds_per_bit_q8_;
    int most_regained_ = 0;  ///< score by which better rolls than the reading's exceed it, in all
    std::array<std::uint8_t, kMaxLines> rolls_{};
};

Contest::Contest(Profile profile, const Lines& lines, const AxisReading& reading, int odds_q8)
    : basis_(code::basis(profile)),
      lines_(lines),
      position_(reading.position),
      odds_per_bit_q8_(odds_q8) {
    int roll = reading.roll;
    std::uint32_t p = reading.position;
    for (int i = 0; i < lines.count(); ++i) {
        rolls_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(roll);
        roll = (roll + delta(profile, p)) % kSections;
        p = p + 1 == kPositionsPerAxis ? 0 : p + 1;
        const LineScores& scores = lines[i];
        most_regained_ += *std::max_element(scores.begin(), scores.end()) -
                          scores[rolls_[static_cast<std::size_t>(i)]];
    }
}

/// Rivals whose place differs in two or more sequences and that share fewer lines in a row.
float Contest::sum_of_far_rivals(int shared_lines) const {
    ExpectedRivals expected(shared_lines - 1);
    std::array<float, kSections> line_odds;
    for (int line = 0; line < lines_.count(); ++line) {
        for (int shift = 0; shift < kSections; ++shift) {
            line_odds[static_cast<std::size_t>(shift)] = odds(loss(line, shift));
        }
        expected.add_line(line_odds);
    }
    return expected.sum();
}

/// Rivals whose place differs in one sequence only: one by one, with every shift at which they
/// share some line with the reading.
float Contest::sum_of_single_rivals() const {
    float sum = 0;
    for (const code::Secondary& a : basis_) {
        const std::uint32_t own = position_ % a.length;
        for (std::uint32_t rival = 0; rival < a.length; ++rival) {
            if (rival == own) continue;
            std::array<std::int16_t, kMaxLines> growth;  // of the rival's roll beyond the reading's
            std::uint32_t o = own;
            std::uint32_t r = rival;
            int grown = 0;
            for (int line = 0; line < lines_.count(); ++line) {
                growth[static_cast<std::size_t>(line)] = static_cast<std::int16_t>(grown);
                grown = (grown + a.weight * (a.digits[r] - a.digits[o])) % kSections;
                o = o + 1 == a.length ? 0 : o + 1;
                r = r + 1 == a.length ? 0 : r + 1;
            }
            for (int shared = 0; shared < lines_.count(); ++shared) {
                sum += odds_of_growth(growth, shared);
            }
        }
    }
    return sum;
}

/// Odds of a rival that shares the line `shared`, and none before.
float Contest::odds_of_growth(const std::array<std::int16_t, kMaxLines>& growth, int shared) const {
    const int base = growth[static_cast<std::size_t>(shared)];
    int lost = 0;
    for (int i = 1; i < lines_.count(); ++i) {
        // Outwards from the shared line, where most is lost soonest; its predecessors last.
        const int line = (shared + i) % lines_.count();
        const int shift = (growth[static_cast<std::size_t>(line)] - base) % kSections;
        if (shift == 0 && line < shared) return 0;
        lost += loss(line, shift);
        if (is_hopeless(lost)) return kNegligible;
    }
    return odds(lost);
}

/// The same position in other sections: all lines differ, by the same shift.
float Contest::sum_of_other_sections() const {
    float sum = 0;
    for (int shift = 1; shift < kSections; ++shift) {
        int lost = 0;
        for (int line = 0; line < lines_.count(); ++line)
            lost += loss(line, shift);
        sum += odds(lost);
    }
    return sum;
}

/// By how much more a rival's roll grows than the reading's from `step` lines after a shared run's
/// beginning to the next line.
int Contest::difference(const Places& own, const Places& rival, int step) const {
    int sum = 0;
    for (std::size_t k = 0; k < basis_.size(); ++k) {
        const code::Secondary& a = basis_[k];
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
float Contest::odds_of(const Places& own, const Places& rival, int run, int shared_lines) const {
    int lost = 0;
    int shift = 0;
    for (int line = run + shared_lines; line < lines_.count(); ++line) {
        shift = (shift + difference(own, rival, line - 1 - run)) % kSections;
        lost += loss(line, shift);
        if (is_hopeless(lost)) return kNegligible;
    }
    shift = 0;
    for (int line = run - 1; line >= 0; --line) {
        shift = (shift - difference(own, rival, line - run)) % kSections;
        lost += loss(line, shift);
        if (is_hopeless(lost)) return kNegligible;
    }
    return odds(lost);
}

/// Rivals that share that many consecutive lines, four or five, or more: one by one, from the
/// places in the secondary sequences at which the digits of the three or four differences stand
/// again.
float Contest::sum_of_near_rivals(int shared_lines) const {
    const auto order = static_cast<std::size_t>(shared_lines - 4);
    float sum = 0;
    for (int run = 0; run + shared_lines <= lines_.count(); ++run) {
        Places own;
        for (std::size_t k = 0; k < own.size(); ++k) {
            own[k] = (position_ + static_cast<std::uint32_t>(run)) % basis_[k].length;
        }
        Places rival = own;
        for (std::size_t k = 0; k < own.size();) {
            for (k = 0; k < own.size(); ++k) {
                rival[k] = basis_[k].next_twins[order][rival[k]];
                if (rival[k] != own[k]) break;
            }
            if (k < own.size()) sum += odds_of(own, rival, run, shared_lines);
        }
    }
    return sum;
}

}  // namespace

int odds_per_bit_q8(const Confidence& confidence) {
    const int allowed = confidence.wrong_weight + 2 * 127;
    int odds_q8 = 0;
    // Bisection: the larger the odds, the less is expected to be wrong.
    for (int step_q8 = 8 * 256; step_q8 > 0; step_q8 /= 2) {
        std::int64_t expected_q16 = 0;
        for (int bin = 0; bin < Confidence::kBins; ++bin) {
            const int weight = bin * 8 + 4;
            const int log_odds_q8 = (odds_q8 + step_q8) * weight / 127;
            const std::int64_t wrong_q16 =
                (std::int64_t{1} << 32) / (65536 + exp2_q16(log_odds_q8));
            expected_q16 += confidence.bits[static_cast<std::size_t>(bin)] * weight * wrong_q16;
        }
        if (expected_q16 > std::int64_t{allowed} << 16) odds_q8 += step_q8;
    }
    return odds_q8;
}

int rivals_log2(Profile profile, const Lines& lines, const AxisReading& reading,
                int odds_per_bit_q8) {
    if (odds_per_bit_q8 <= 0 || lines.count() <= kMostShared) return 0;
    const Contest contest(profile, lines, reading, odds_per_bit_q8);
    const float always = contest.sum_of_single_rivals() + contest.sum_of_other_sections();
    float sum = 0;
    // The more rivals are looked at one by one, the fewer remain to be feared for their number.
    for (const int shared_lines : {kMostShared, kMostShared - 1}) {
        sum = always + contest.sum_of_near_rivals(shared_lines) +
              contest.sum_of_far_rivals(shared_lines);
        if (sum < kFarBelowDoubt) break;
    }
    int exponent = 0;
    std::frexp(sum, &exponent);  // sum < 2^exponent
    return std::min(exponent, 0);
}

}  // namespace dotpose::core
