#include "core/decode/quick_rivals.hpp"

#include <algorithm>
#include <bit>

#include "core/decode/similar_places.hpp"

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

/// What a rival that does not share a line may have in odds there.
struct LineOdds {
    int best_q8 = 0;  ///< at the roll that loses least
    int sum_q8 = 0;   ///< over all rolls but the reading's
};
using AllLineOdds = std::array<LineOdds, kMaxLines>;

/// 2^-b in 2^-12 for each half bit, rounded up.
constexpr std::array<std::uint16_t, 26> kPowers{4096, 2897, 2048, 1449, 1024, 725, 512, 363, 256,
                                                182,  128,  91,   64,   46,   32,  23,  16,  12,
                                                8,    6,    4,    3,    2,    2,   1,   1};

/// log2 of the sum of 2^-b over all other rolls, b being the bits that they lose more than the
/// best.
int log2_of_others_q8(const Contest& contest, int line) {
    const std::int16_t* scores = contest.lines[line].data();
    const int own = contest.own_roll(line);
    const int best = scores[own] - contest.least_loss(line);
    std::uint32_t sum_q12 = 0;
    for (int roll = 0; roll < kSections; ++roll) {
        if (roll == own) continue;
        const auto half_bits =
            static_cast<std::size_t>(-contest.log2_odds_q8(best - scores[roll]) >> 7);
        sum_q12 += kPowers[std::min(half_bits, kPowers.size() - 1)];
    }
    // log2(1 + f) is at most f + 0.087.
    const int whole = static_cast<int>(std::bit_width(sum_q12)) - 1;
    const auto fraction_q8 = static_cast<int>(sum_q12 * 256 >> whole) - 256;
    return (whole - 12) * 256 + fraction_q8 + 23;
}

/// ExpectedRivals with all that share no line lumped together. A step leads to each roll with at
/// most the probability of the one that stays shared, so a line has at most that share of the sum
/// of its odds, and at most the best of them.
int far_log2_q8(const Contest& contest, const Set& set, const AllLineOdds& odds) {
    const int most = contest.most_shared();
    const int equal = set.equal_q8 + kUnevenness_q8;
    // All sums are divided by the probability that every line so far is shared: then those that
    // share the lines from one on, and none before it, stay as they are.
    std::array<int, kMostShared + kMaxLines> sharing;
    std::fill_n(sharing.begin(), kMostShared, kNever_q8);
    int* newest = &sharing[kMostShared];
    *newest = 0;
    int apart = odds[0].sum_q8;
    int sum = 0;
    for (int line = 0;;) {
        sum = apart;
        for (int n = 0; n < most; ++n)
            sum = add_log2(sum, newest[-n]);
        if (++line == contest.lines.count()) break;
        const LineOdds& here = odds[static_cast<std::size_t>(line)];
        *++newest = apart;
        apart = sum - equal + std::min(here.best_q8 + kUnevenness_q8, here.sum_q8 + equal);
    }
    return sum + (contest.lines.count() - 1) * equal + set.rivals_q8;
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

/// Rivals that differ in one sequence, at every shift at which they share lines enough to matter.
class ByShift {
  public:
    ByShift(const Contest& contest, int enough);

    /// Adds the odds of the rival at a place to a sum.
    int add(std::size_t sequence, std::uint32_t place, int sum) const {
        return all_matter_ || may_matter(sequence, place) ? add_closely(sequence, place, sum) : sum;
    }

  private:
    struct Loss {
        int line;
        int least;  ///< of who does not share the line
    };

    bool may_matter(std::size_t sequence, std::uint32_t place) const;
    int add_closely(std::size_t sequence, std::uint32_t place, int sum) const;

    const Contest& contest_;
    int enough_;
    std::size_t count_ = 0;               ///< of lines at which something is lost
    std::size_t anchors_ = 0;             ///< who shares none of the first ones has lost enough
    bool all_matter_ = false;             ///< even who shares none at all
    std::array<Loss, kMaxLines> losses_;  ///< the greatest first
};

ByShift::ByShift(const Contest& contest, int enough) : contest_(contest), enough_(enough) {
    for (int line = 0; line < contest.lines.count(); ++line) {
        const int least = contest.least_loss(line);
        if (least <= 0) continue;
        std::size_t i = count_++;
        for (; i > 0 && losses_[i - 1].least < least; --i)
            losses_[i] = losses_[i - 1];
        losses_[i] = {line, least};
    }
    int lost = 0;
    for (; anchors_ < count_ && lost < enough; ++anchors_)
        lost += losses_[anchors_].least;
    all_matter_ = lost < enough;
}

/// Whether at some shift not enough is lost.
// By itself, so that small processors can keep all it needs in registers.
[[gnu::noinline]] bool ByShift::may_matter(std::size_t sequence, std::uint32_t place) const {
    const std::uint8_t* own = contest_.basis[sequence].rolls + contest_.places[sequence];
    const std::uint8_t* rival = contest_.basis[sequence].rolls + place;
    const auto shift_at = [&](int line) {
        const int shift = rival[line] - own[line];
        return shift < 0 ? shift + kSections : shift;
    };
    const Loss* end = losses_.data() + count_;
    for (const Loss* anchor = losses_.data(); anchor != losses_.data() + anchors_; ++anchor) {
        const int shift = shift_at(anchor->line);
        int lost = 0;
        for (const Loss* loss = losses_.data(); loss != end && lost < enough_; ++loss) {
            if (shift_at(loss->line) != shift) lost += loss->least;
        }
        if (lost < enough_) return true;
    }
    return false;
}

int ByShift::add_closely(std::size_t sequence, std::uint32_t place, int sum) const {
    Growth growth;
    grow(contest_, sequence, place, growth);
    std::array<int, kSections> kept{};  // by the shift at which lines are shared
    int in_all = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        in_all += losses_[i].least;
        kept[growth[static_cast<std::size_t>(losses_[i].line)]] += losses_[i].least;
    }
    for (int line = 0; line < contest_.lines.count(); ++line) {
        int& here = kept[growth[static_cast<std::size_t>(line)]];
        if (in_all - here < enough_) {
            const std::optional<int> lost = loss_of_growth(contest_, growth, line);
            const int odds = lost ? contest_.log2_odds_q8(*lost) : kNever_q8;
            if (odds > kPassedOver_q8) sum = add_log2(sum, odds);
        }
        // Those that share another line at the same shift are the same.
        here = 0;
    }
    return sum;
}

/// Rivals that differ in one sequence: those that have surely lost enough are passed over; the
/// others, few, are looked at one by one.
int singles_log2_q8(const Contest& contest) {
    const int lines = contest.lines.count();
    const int enough = contest.loss_for(kPassedOver_q8) + contest.most_regained();
    ByShift by_shift(contest, enough);
    int sum = kSingles_q8 + kPassedOver_q8 +
              256 * static_cast<int>(std::bit_width(static_cast<unsigned>(lines)));
    visit_similar_places(contest, Steps(contest, enough, Excused::none),
                         [&](std::size_t sequence, std::uint32_t place) {
                             sum = by_shift.add(sequence, place, sum);
                         });
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
