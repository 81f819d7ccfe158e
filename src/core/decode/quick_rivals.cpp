#include "core/decode/quick_rivals.hpp"

#include <algorithm>
#include <bit>

namespace dotpose::core {
namespace {

/// log2 of numbers of rivals, and of shifts at which a rival shares no line, in 2^-8, rounded up.
constexpr int kShifts_q8 = 1525;   // 62
constexpr int kSingles_q8 = 2441;  // 741
/// Odds, as a power of two, at which single rivals are counted that have less, known or not.
constexpr int kPassedOver_q8 = -52 * 256;

/// Rivals that differ in the places of a set of sequences: how many, and how probable it is that
/// they all show the reading's digits in a step.
struct Set {
    int rivals_q8 = 0;
    int equal_q8 = 0;
};
/// Two with a3, two others, three with a3, the three others, all four.
constexpr std::array<Set, 5> kSets{
    {{3694, -661}, {4444, -811}, {5712, -1067}, {6057, -1217}, {7326, -1473}}};
/// log2(1.03): see ExpectedRivals.
constexpr int kUnevenness_q8 = 11;

/// Lines in a row that two positions share at most.
int most_shared(const Contest& contest) {
    constexpr int kMisprinted = 7;
    return contest.basis[3].has_twins ? kMisprinted : code::kOrder;
}

/// What a rival that does not share a line may have in odds there.
struct LineOdds {
    int best_q8 = 0;  ///< at the roll that loses least
    int sum_q8 = 0;   ///< over all rolls but the reading's
};
using AllLineOdds = std::array<LineOdds, kMaxLines>;

/// log2 of the sum of 2^-b over all other rolls, b being the bits that they lose more than the
/// best.
int log2_of_others_q8(const Contest& contest, int line) {
    // 2^-b in 2^-12 for each half bit, rounded up.
    constexpr std::array<std::uint16_t, 26> kPowers{
        4096, 2897, 2048, 1449, 1024, 725, 512, 363, 256, 182, 128, 91, 64,
        46,   32,   23,   16,   12,   8,   6,   4,   3,   2,   2,   1,  1};
    std::uint32_t sum_q12 = 0;
    for (int shift = 1; shift < kSections; ++shift) {
        const int more = contest.loss(line, shift) - contest.least_loss(line);
        const auto half_bits = static_cast<std::size_t>(-contest.log2_odds_q8(more) >> 7);
        sum_q12 += kPowers[std::min(half_bits, kPowers.size() - 1)];
    }
    // log2(1 + f) is at most f + 0.087.
    const int whole = std::bit_width(sum_q12) - 1;
    const auto fraction_q8 = static_cast<int>(sum_q12 * 256 >> whole) - 256;
    return (whole - 12) * 256 + fraction_q8 + 23;
}

/// ExpectedRivals with all that share no line lumped together. A step leads to each roll with at
/// most the probability of the one that stays shared, so a line has at most that share of the sum
/// of its odds, and at most the best of them.
int far_log2_q8(const Contest& contest, const Set& set, const AllLineOdds& odds) {
    constexpr std::size_t kMostShared = 7;
    const auto most = static_cast<std::size_t>(most_shared(contest));
    std::array<int, kMostShared> shared;  // lines in a row so far, less one
    shared.fill(kNever_q8);
    int apart = 0;
    int sum = 0;
    for (int line = 0; line < contest.lines.count(); ++line) {
        const LineOdds& here = odds[static_cast<std::size_t>(line)];
        if (line == 0) {
            shared[0] = 0;
            apart = here.sum_q8;
        } else {
            const int equal = set.equal_q8 + kUnevenness_q8;
            for (std::size_t n = most; --n > 0;)
                shared[n] = shared[n - 1] + equal;
            shared[0] = apart + equal;
            apart = sum + std::min(here.best_q8 + kUnevenness_q8, here.sum_q8 + equal);
        }
        sum = apart;
        for (std::size_t n = 0; n < most; ++n)
            sum = add_log2(sum, shared[n]);
    }
    return sum + set.rivals_q8;
}

/// All sets together: roughly, with the number of rolls times the best for the sum, or exactly.
int far_log2_q8(const Contest& contest, bool roughly) {
    AllLineOdds odds;
    for (int line = 0; line < contest.lines.count(); ++line) {
        const int best = contest.log2_odds_q8(contest.least_loss(line));
        odds[static_cast<std::size_t>(line)] = {
            best, best + (roughly ? kShifts_q8 : log2_of_others_q8(contest, line))};
    }
    int sum = kNever_q8;
    for (const Set& set : kSets)
        sum = add_log2(sum, far_log2_q8(contest, set, odds));
    return sum;
}

/// Steps between adjacent lines in which digits are compared.
constexpr int kMostSteps = 18;

/// What a rival has lost at least, from the steps in which its digits differ from the reading's:
/// there it does not share one of the two lines. Every other step, so that none counts twice.
class StepLosses {
  public:
    StepLosses(const Contest& contest, int first_line, int steps, int enough);

    /// Whether either the even or the odd steps say that enough is lost.
    bool suffice(std::uint32_t steps_that_differ) const {
        std::uint32_t sums = missing_;
        for (const auto& group : sums_) {
            sums += group[steps_that_differ & ((1U << kGroup) - 1)];
            steps_that_differ >>= kGroup;
        }
        return (sums & kTops) != 0;
    }

  private:
    static constexpr int kGroup = 6;
    static constexpr std::uint32_t kTops = 0x80008000;
    static constexpr int kMostLoss = 0x7000 / kMostSteps;

    /// Of each combination of steps of a group: even ones in the lower half, odd ones in the upper.
    std::array<std::array<std::uint32_t, 1 << kGroup>, kMostSteps / kGroup> sums_{};
    std::uint32_t missing_;  ///< what is not enough, in each half, from the top bit down
};

StepLosses::StepLosses(const Contest& contest, int first_line, int steps, int enough) {
    missing_ = static_cast<std::uint32_t>(0x8000 - std::min(enough, 0x7FFF)) * 0x10001;
    for (int step = 0; step < kMostSteps; ++step) {
        auto& group = sums_[static_cast<std::size_t>(step / kGroup)];
        const std::size_t bit = std::size_t{1} << (step % kGroup);
        std::uint32_t lost = 0;
        if (step < steps) {
            const int line = first_line + step;
            const int least = std::min(contest.least_loss(line), contest.least_loss(line + 1));
            lost = static_cast<std::uint32_t>(std::clamp(least, 0, kMostLoss));
        }
        for (std::size_t i = 0; i < bit; ++i)
            group[bit + i] = group[i] + (step % 2 == 0 ? lost : lost << 16);
    }
}

/// The digits of a sequence from some place on, as two planes of bits.
struct Digits {
    std::uint32_t low = 0;
    std::uint32_t high = 0;

    void push(unsigned digit, int count) {
        low = low >> 1 | (digit & 1) << (count - 1);
        high = high >> 1 | digit >> 1 << (count - 1);
    }
    std::uint32_t differ(Digits other) const { return (low ^ other.low) | (high ^ other.high); }
};

/// Places of a sequence.
struct Places {
    std::array<std::uint8_t, 241> places;
    int count = 0;
};

/// Those at which the digits differ so little from those at `own` that not enough is lost.
// By itself, so that small processors can keep all it needs in registers.
[[gnu::noinline]] Places similar_places(const code::Secondary& a, std::uint32_t own, int count,
                                        const StepLosses& losses) {
    Digits ours;
    Digits theirs;
    std::uint32_t ahead = 0;
    std::uint32_t place = own;
    for (int i = 0; i < count; ++i) {
        ours.push(a.digits[place], count);
        if (++place == a.length) place = 0;
        theirs.push(a.digits[ahead], count);
        if (++ahead == a.length) ahead = 0;
    }
    Places similar;
    for (place = 0; place < a.length; ++place) {
        if (place != own && !losses.suffice(ours.differ(theirs))) {
            similar.places[static_cast<std::size_t>(similar.count++)] =
                static_cast<std::uint8_t>(place);
        }
        theirs.push(a.digits[ahead], count);
        if (++ahead == a.length) ahead = 0;
    }
    return similar;
}

/// Rivals with one growth, at every shift at which they share lines enough to matter.
class ByShift {
  public:
    ByShift(const Contest& contest, int enough) : contest_(contest), enough_(enough) {
        for (int line = 0; line < contest.lines.count(); ++line)
            in_all_ += std::max(contest.least_loss(line), 0);
    }

    /// Adds their odds to a sum.
    int add(const Growth& growth, int sum) {
        const int lines = contest_.lines.count();
        bool matters = false;
        for (int line = 0; line < lines; ++line) {
            int& kept = kept_[growth[static_cast<std::size_t>(line)]];
            kept += std::max(contest_.least_loss(line), 0);
            matters |= in_all_ - kept < enough_;
        }
        for (int line = 0; line < lines; ++line) {
            int& kept = kept_[growth[static_cast<std::size_t>(line)]];
            if (matters && in_all_ - kept < enough_) {
                const std::optional<int> lost = loss_of_growth(contest_, growth, line);
                const int odds = lost ? contest_.log2_odds_q8(*lost) : kNever_q8;
                if (odds > kPassedOver_q8) sum = add_log2(sum, odds);
            }
            kept = 0;
        }
        return sum;
    }

  private:
    const Contest& contest_;
    int enough_;  ///< loss
    int in_all_ = 0;
    std::array<int, kSections> kept_{};  ///< by the shift at which lines are shared
};

/// Rivals that differ in one sequence: those that have surely lost enough are passed over; the
/// others, few, are looked at one by one.
int singles_log2_q8(const Contest& contest) {
    const int lines = contest.lines.count();
    const int steps = std::min(lines - 1, kMostSteps);
    const int first_line = (lines - 1 - steps) / 2;
    const int enough = contest.loss_for(kPassedOver_q8) + contest.most_regained();
    const StepLosses losses(contest, first_line, steps, enough);
    ByShift by_shift(contest, enough);
    int sum = kSingles_q8 + kPassedOver_q8 +
              256 * static_cast<int>(std::bit_width(static_cast<unsigned>(lines)));
    for (const code::Secondary& a : contest.basis) {
        const std::uint32_t own = contest.position % a.length;
        const auto ahead = static_cast<std::uint32_t>(first_line);
        const std::uint32_t own_ahead = (own + ahead) % a.length;
        const Places similar = similar_places(a, own_ahead, steps, losses);
        for (int i = 0; i < similar.count; ++i) {
            const std::uint32_t place = similar.places[static_cast<std::size_t>(i)];
            const std::uint32_t rival = place + (place < ahead ? a.length : 0U) - ahead;
            sum = by_shift.add(growth_of(contest, a, rival), sum);
        }
    }
    return sum;
}

int other_sections_log2_q8(const Contest& contest) {
    int lost = 0;
    for (int line = 0; line < contest.lines.count(); ++line)
        lost += contest.least_loss(line);
    return kShifts_q8 + contest.log2_odds_q8(lost);
}

}  // namespace

int quick_rivals_log2_q8(const Contest& contest, int limit_q8) {
    // Nobody wants to know odds like these more exactly.
    constexpr int kSmall_q8 = -36 * 256;
    int far = far_log2_q8(contest, true);
    if (far > kSmall_q8) far = far_log2_q8(contest, false);
    const int sum = add_log2(other_sections_log2_q8(contest), far);
    if (sum >= limit_q8) return 0;
    return std::min(add_log2(sum, singles_log2_q8(contest)), 0);
}

}  // namespace dotpose::core
