#include "core/integrity/quick_alternatives.hpp"

#include <algorithm>
#include <bit>

#include "code/unshared_lines.hpp"
#include "core/integrity/alternative_sets.hpp"
#include "core/integrity/least_losses.hpp"
#include "core/integrity/similar_places.hpp"
#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// log2 of the number of places of all sequences, 741, in 2^-8, rounded up.
constexpr int kSingles_q8 = 2441;
/// Odds below which no closer estimate is needed.
constexpr int kSmallOdds_q8 = -36 * 256;
/// The default limit: even if a caller accepts more doubt, estimates are as close as for this.
constexpr int kUsualLimit_q8 = -30 * 256;
/// Odds, as log2, at which single alternatives are counted that are passed over because they have
/// less.
constexpr int kPassedOver_q8 = -52 * 256;

/// The odds that an alternative may have in a line that it does not share, as log2.
struct LineOdds {
    int best_q8;  ///< at the roll that loses least
    int sum_q8;   ///< over all rolls but the reading's
};
using AllLineOdds = std::array<LineOdds, kMaxLines>;

/// 2^-b in 2^-12, for each half bit b, rounded up.
constexpr std::array<std::uint16_t, 26> kPowers{4096, 2897, 2048, 1449, 1024, 725, 512, 363, 256,
                                                182,  128,  91,   64,   46,   32,  23,  16,  12,
                                                8,    6,    4,    3,    2,    2,   1,   1};

/// Returns log2 of the sum of 2^-b over all other rolls, where b is by how many bits a roll loses
/// more than the best of them.
int log2_of_others_q8(const LikelihoodRatios& ratios, int line) {
    const std::int16_t* scores = ratios.lines[line].data();
    const int own = ratios.own_roll(line);
    const int best = scores[own] - ratios.least_loss(line);
    const auto power_q12 = [&](int score) -> std::uint32_t {
        const auto half_bits = static_cast<std::size_t>(-ratios.log2_odds_q8(best - score) >> 7);
        return kPowers[std::min(half_bits, kPowers.size() - 1)];
    };
    // Most rolls lose so much that they have the least power: 12 bits, and what rounding may take.
    const int hardly_any = best - ratios.loss_for(-12 * 256 - 8);
    std::uint32_t sum_q12 = 0;
    for (int roll = 0; roll < kSections; ++roll)
        sum_q12 += scores[roll] <= hardly_any ? kPowers.back() : power_q12(scores[roll]);
    sum_q12 -= power_q12(scores[own]);
    return log2_at_most_q8(sum_q12) - 12 * 256;
}

/// Returns the expectation of ExpectedAlternatives, with all shifts at which a line is not shared
/// lumped together. A step leads to each of them with at most the probability of staying at a
/// shared line, so a line has at most that share of the sum of its odds, and at most the best of
/// them.
int far_log2_q8(const LikelihoodRatios& ratios, const AlternativeSet& set,
                const AllLineOdds& odds) {
    static_assert(code::kOrder % 2 == 1 && kMostShared % 2 == 1);
    const auto most = static_cast<std::size_t>(ratios.most_shared());
    const int equal = set.equal_q8 + kUnevenness_q8;
    // All sums are divided by the probability that every line so far is shared. So the sum of those
    // that share the lines from one on, and none before it, stays as it is.
    std::array<int, kMostShared + kMaxLines> sharing;
    // Each element of `sharing` plus the one before it, so that sums have half as many terms.
    std::array<int, kMostShared + kMaxLines> pairs;
    std::fill_n(sharing.begin(), kMostShared, kNever_q8);
    std::fill_n(pairs.begin(), kMostShared, kNever_q8);
    std::size_t newest = kMostShared;
    sharing[newest] = pairs[newest] = 0;
    int apart = odds[0].sum_q8;
    int sum = 0;
    for (int line = 0;;) {
        sum = add_log2(apart, sharing[newest + 1 - most]);
        for (std::size_t n = 0; n + 1 < most; n += 2)
            sum = add_log2(sum, pairs[newest - n]);
        if (++line == ratios.count()) break;
        const LineOdds& here = odds[static_cast<std::size_t>(line)];
        ++newest;
        sharing[newest] = apart;
        pairs[newest] = add_log2(apart, sharing[newest - 1]);
        apart = sum - equal + std::min(here.best_q8 + kUnevenness_q8, here.sum_q8 + equal);
    }
    return sum + (ratios.count() - 1) * equal + set.alternatives_q8;
}

/// Returns a bound of the odds of all alternatives of all sets that share at most seven lines, and
/// so lose in all others. At which roll they are in the first line is not known. There are fewer
/// than 2^lines ways to share lines.
int sharing_few_log2_q8(const LikelihoodRatios& ratios) {
    constexpr std::size_t kFew = 7;
    std::array<int, kFew> most{};  // the greatest losses
    int lost = 0;
    for (int line = 0; line < ratios.count(); ++line) {
        int loss = ratios.least_loss(line);
        lost += loss;
        for (int& greater : most) {
            if (loss > greater) std::swap(loss, greater);
        }
    }
    for (const int loss : most)
        lost -= loss;
    constexpr int kSets_q8 = 2 * 256;
    return kAlternativeSets.back().alternatives_q8 + kSets_q8 + kOtherRolls_q8 +
           (256 + kUnevenness_q8) * ratios.count() + ratios.log2_odds_q8(lost);
}

/// Returns the sum over all sets; `roughly` takes the number of rolls times the best for the sum
/// over rolls. Once it is above `enough`, further sets need not be added.
int far_log2_q8(const LikelihoodRatios& ratios, bool roughly, int enough) {
    AllLineOdds odds;
    odds[0] = {};
    for (int line = 0; line < ratios.count(); ++line) {
        const int best = ratios.log2_odds_q8(ratios.least_loss(line));
        const int others = ratios.is_of_bits() ? ratios.log2_of_nearest_q8(line)
                           : roughly           ? kOtherRolls_q8
                                               : log2_of_others_q8(ratios, line);
        odds[static_cast<std::size_t>(line)] = {best, best + others};
    }
    int sum = far_log2_q8(ratios, kAlternativeSets.front(), odds);
    // The four other sets have more alternatives, which share a line more rarely: those of each
    // that share more than seven lines have less than half of the odds of the first set.
    constexpr int kThreeTimes_q8 = 406;
    if (sum + kThreeTimes_q8 < kSmallOdds_q8) {
        const int with_others = add_log2(sum + kThreeTimes_q8, sharing_few_log2_q8(ratios));
        if (with_others < kSmallOdds_q8) return with_others;
    }
    for (const AlternativeSet& set : std::span(kAlternativeSets).subspan(1)) {
        if (sum > enough) break;
        sum = add_log2(sum, far_log2_q8(ratios, set, odds));
    }
    return sum;
}

/// Sums up alternatives that differ in one sequence, at every shift at which they share enough
/// lines to matter.
class ByShift {
  public:
    ByShift(const LikelihoodRatios& ratios, int enough);

    /// Adds the odds of the alternative at a place to a sum, and returns it.
    int add(std::size_t sequence, std::uint32_t place, int sum) {
        if (sequence != sequence_) begin(sequence);
        return may_matter(rolls_ + place) ? add_closely(place, sum) : sum;
    }

  private:
    struct Loss {
        std::uint16_t least;  ///< lost by those that do not share the line
        std::uint8_t line;
        std::uint8_t own = 0;  ///< what the reading's place adds to the roll there
    };

    void begin(std::size_t sequence) {
        sequence_ = sequence;
        rolls_ = ratios_.basis[sequence].rolls;
        const std::uint8_t* own = rolls_ + ratios_.places[sequence];
        for (Loss& loss : std::span(losses_).first(count_))
            loss.own = own[loss.line];
    }
    bool may_matter(const std::uint8_t* alternative);
    int add_closely(std::uint32_t place, int sum) const;

    const LikelihoodRatios& ratios_;
    std::size_t sequence_ = SIZE_MAX;
    const std::uint8_t* rolls_ = nullptr;
    std::uint32_t enough_;
    std::size_t count_ = 0;               ///< of lines with a loss
    std::array<Loss, kMaxLines> losses_;  ///< the largest first
    std::uint32_t in_all_ = 0;
    /// Number and sum of the first losses; the sum is not enough without the largest, which may be
    /// kept.
    std::size_t first_count_ = 0;
    std::uint32_t first_losses_ = 0;
    /// What is not lost at each shift, plus `none_`; smaller values are left from earlier
    /// alternatives.
    std::array<std::uint32_t, kSections> kept_{};
    std::uint32_t none_;
};

ByShift::ByShift(const LikelihoodRatios& ratios, int enough)
    : ratios_(ratios), enough_(static_cast<std::uint32_t>(enough)), none_(enough_) {
    for (int line = 0; line < ratios.count(); ++line) {
        if (ratios.least_loss(line) <= 0) continue;
        const auto least = static_cast<std::uint16_t>(ratios.least_loss(line));
        std::size_t i = count_++;
        for (; i > 0 && losses_[i - 1].least < least; --i)
            losses_[i] = losses_[i - 1];
        losses_[i] = {least, static_cast<std::uint8_t>(line)};
        in_all_ += least;
    }
    while (first_count_ < count_) {
        const std::uint32_t with_next = first_losses_ + losses_[first_count_].least;
        if (with_next >= enough_ + losses_[0].least) break;
        first_losses_ = with_next;
        ++first_count_;
    }
}

/// Returns whether too little is lost at some shift for the place to be passed over.
// Not inlined, so that small processors can keep everything in registers.
[[gnu::noinline]] bool ByShift::may_matter(const std::uint8_t* alternative) {
    std::uint32_t* const kept = kept_.data();
    const std::uint32_t none = none_ += in_all_;
    std::uint32_t most = none;
    const auto keep = [&](const Loss& loss) {
        const int difference = alternative[loss.line] - loss.own;
        const int shift = difference < 0 ? difference + kSections : difference;
        const std::uint32_t now = std::max(kept[shift], none) + loss.least;
        kept[shift] = now;
        most = std::max(most, now);
    };
    const Loss* loss = losses_.data();
    for (const Loss* const end = loss + first_count_; loss != end; ++loss)
        keep(*loss);
    // If less than this is kept, enough is lost in the lines so far.
    std::uint32_t most_to_keep = none - enough_ + first_losses_;
    for (const Loss* const end = losses_.data() + count_; loss != end; ++loss) {
        keep(*loss);
        most_to_keep += loss->least;
        if (most <= most_to_keep) return false;
    }
    return true;
}

/// Adds the odds of a place at all shifts that matter, line by line. Not inlined, for registers.
[[gnu::noinline]] int ByShift::add_closely(std::uint32_t place, int sum) const {
    RollOffsets offsets;
    set_roll_offsets(ratios_, sequence_, place, offsets);
    std::array<std::uint32_t, kSections> kept;  // by the shift at which lines are shared
    for (int line = 0; line < ratios_.count(); ++line)
        kept[offsets[static_cast<std::size_t>(line)]] = 0;
    for (std::size_t i = 0; i < count_; ++i)
        kept[offsets[static_cast<std::size_t>(losses_[i].line)]] += losses_[i].least;
    for (int line = 0; line < ratios_.count(); ++line) {
        std::uint32_t& here = kept[offsets[static_cast<std::size_t>(line)]];
        if (in_all_ - here < enough_) {
            const std::optional<int> lost = loss_of_offsets(ratios_, offsets, line);
            const int odds = lost ? ratios_.log2_odds_q8(*lost) : kNever_q8;
            if (odds > kPassedOver_q8) sum = add_log2(sum, odds);
        }
        // Shared lines at the same shift belong to the same alternative, which counts once.
        here = 0;
    }
    return sum;
}

/// Returns a bound of the odds of the alternatives in one sequence that share a line, by what all
/// of them lose. They may share one at as many shifts as there are lines.
int by_table_log2_q8(const LikelihoodRatios& ratios, const UnsharedLines& unshared,
                     std::size_t sequence) {
    const int lost = unshared.least_loss(sequence, Sharing::at_one_shift) - ratios.most_regained();
    const int alternatives = ratios.count() * static_cast<int>(ratios.basis[sequence].length);
    return log2_at_most_q8(static_cast<std::uint32_t>(alternatives)) +
           ratios.log2_odds_q8(std::max(lost, 0));
}

/// A set of sequences, one in each bit.
using Sequences = unsigned;
constexpr Sequences kAllSequences = 15;

/// Adds the odds that tables give to the alternatives in some sequences, where these are below
/// `little_q8`. Returns the sequences that are left.
Sequences add_by_tables(const LikelihoodRatios& ratios, int little_q8, Sequences sequences,
                        int& sum) {
    for (std::size_t table = code::kUnsharedOf.size(); table-- > 0 && sequences != 0;) {
        if (code::kUnsharedOf[table] > ratios.count()) continue;
        const UnsharedLines unshared(ratios, code::kUnsharedOf[table]);
        for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
            if ((sequences >> k & 1) == 0) continue;
            const int by_table = by_table_log2_q8(ratios, unshared, k);
            if (by_table >= little_q8) continue;
            sum = add_log2(sum, by_table);
            sequences ^= 1U << k;
        }
    }
    return sequences;
}

/// Returns the odds of the alternatives in some sequences. Those that have surely lost enough are
/// passed over; the few others are looked at one by one.
int singles_log2_q8(const LikelihoodRatios& ratios, Sequences sequences) {
    const int lines = ratios.count();
    const int enough = ratios.loss_for(kPassedOver_q8) + ratios.most_regained();
    int sum = kSingles_q8 + kPassedOver_q8 +
              256 * static_cast<int>(std::bit_width(static_cast<unsigned>(lines)));
    if (least_losses(ratios, false)[static_cast<std::size_t>(lines)] >= enough) return sum;
    ByShift by_shift(ratios, enough);
    const UnsharedLines unshared(ratios);
    visit_similar_places(
        ratios, Steps(ratios, enough, Excused::none),
        [&](std::size_t sequence) {
            return (sequences >> sequence & 1) == 0 ||
                   unshared.all_lose(sequence, Sharing::at_one_shift, enough);
        },
        [&](std::size_t sequence, std::uint32_t place) {
            sum = by_shift.add(sequence, place, sum);
        });
    return sum;
}

int other_sections_log2_q8(const LikelihoodRatios& ratios) {
    int lost = 0;
    for (int line = 0; line < ratios.count(); ++line)
        lost += ratios.least_loss(line);
    return kOtherRolls_q8 + ratios.log2_odds_q8(lost);
}

}  // namespace

int quick_alternatives_log2_q8(const LikelihoodRatios& ratios, int limit_q8) {
    // Hard bits have no closer sum, so all sets have to be counted.
    const bool is_last = ratios.is_of_bits();
    int far = far_log2_q8(ratios, true, is_last ? limit_q8 : kSmallOdds_q8);
    if (far > kSmallOdds_q8 && !is_last) far = far_log2_q8(ratios, false, limit_q8);
    const int other_sections = other_sections_log2_q8(ratios);
    const int sum = add_log2(other_sections, far);
    if (sum >= limit_q8) return 0;
    Sequences sequences = kAllSequences;
    int singles = kNever_q8;
    if (is_last) {
        // Odds by tables are larger than the true ones, but save most of the work.
        constexpr int kLittle_q8 = -5 * 256;
        const int little_q8 = std::min(limit_q8, kUsualLimit_q8) + kLittle_q8;
        sequences = add_by_tables(ratios, little_q8, sequences, singles);
        // Alternatives that share no line lose as much as those in other sections.
        singles = add_log2(singles, kSingles_q8 + other_sections);
    }
    if (sequences != 0) singles = add_log2(singles, singles_log2_q8(ratios, sequences));
    return std::min(add_log2(sum, singles), 0);
}

}  // namespace dotpose::core
