#include "core/integrity/quick_alternatives.hpp"

#include <algorithm>
#include <bit>

#include "code/unshared_lines.hpp"
#include "core/integrity/alternative_sets.hpp"
#include "core/integrity/min_losses.hpp"
#include "core/integrity/similar_places.hpp"
#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// log2(741) in units of 2^-8, rounded up. The four sequences have 741 places in total.
constexpr int kSingles_q8 = 2441;
/// Limit on the odds of the far alternatives, as log2 in units of 2^-8. If a bound on these odds is
/// below this limit, no tighter bound is computed.
constexpr int kSmallOdds_q8 = -36 * 256;
/// Default limit on the error probability, as log2 in units of 2^-8. If the caller's limit is
/// larger, the default limit determines which bounds are tight enough.
constexpr int kUsualLimit_q8 = -30 * 256;
/// Upper bound on the odds of a single alternative that is not evaluated, as log2 in units of 2^-8.
constexpr int kSkippedOdds_q8 = -52 * 256;

/// Odds in a line that an alternative does not share, as log2 in units of 2^-8. An "other roll" is
/// any roll except the roll of the reading.
struct LineOdds {
    int best_q8;  ///< odds of the best other roll
    int sum_q8;   ///< summed odds of all other rolls
};
using AllLineOdds = std::array<LineOdds, kMaxLines>;

/// 2^-b in units of 2^-12, rounded up, for b = 0, 1/2, 1, ...
constexpr std::array<std::uint16_t, 26> kPowers{4096, 2897, 2048, 1449, 1024, 725, 512, 363, 256,
                                                182,  128,  91,   64,   46,   32,  23,  16,  12,
                                                8,    6,    4,    3,    2,    2,   1,   1};

/// Returns log2(sum / best) for a line, in units of 2^-8, rounded up. `sum` and `best` are the sum
/// and the maximum of the odds at all other rolls.
int log2_of_others_q8(const LikelihoodRatios& ratios, int line) {
    const std::int16_t* scores = ratios.lines[line].data();
    const int own = ratios.own_roll(line);
    const int best = scores[own] - ratios.min_loss(line);
    const auto power_q12 = [&](int score) -> std::uint32_t {
        const auto half_bits = static_cast<std::size_t>(-ratios.log2_odds_q8(best - score) >> 7);
        return kPowers[std::min(half_bits, kPowers.size() - 1)];
    };
    // The odds of most rolls are smaller than the odds of the best roll by a factor of at least
    // 2^12. Each of these rolls adds the last element of kPowers to the sum.
    const int min_power_score = best - ratios.loss_for(-12 * 256 - 8);
    std::uint32_t sum_q12 = 0;
    for (int roll = 0; roll < kSections; ++roll)
        sum_q12 += scores[roll] <= min_power_score ? kPowers.back() : power_q12(scores[roll]);
    sum_q12 -= power_q12(scores[own]);
    return log2_at_most_q8(sum_q12) - 12 * 256;
}

/// Returns an upper bound on the expected odds of the alternatives in one set, as log2 in units of
/// 2^-8. The bound distinguishes only between the roll offset 0 and all other roll offsets. At each
/// step, at most one combination of digits changes the roll offset from one given value to another.
/// The probability of this combination is at most the probability p that all digits equal those of
/// the reading. A line that is not shared therefore multiplies the odds by at most p times the
/// summed odds of the other rolls (`LineOdds::sum_q8`). Because the probabilities add up to at most
/// 1, the line also multiplies the odds by at most the odds of the best other roll
/// (`LineOdds::best_q8`).
int far_log2_q8(const LikelihoodRatios& ratios, const AlternativeSet& set,
                const AllLineOdds& odds) {
    static_assert(code::kOrder % 2 == 1 && kMaxShared % 2 == 1);
    const auto max_shared = static_cast<std::size_t>(ratios.max_shared());
    const int equal = set.equal_q8 + kUnevenness_q8;
    // Each element corresponds to one line and contains log2 of the summed odds of the alternatives
    // whose current run of shared lines begins at this line. All sums in this function are divided
    // by the probability that all digits so far are equal. An element therefore does not change
    // while its alternatives continue to share lines.
    std::array<int, kMaxShared + kMaxLines> sharing;
    // pairs[n] is log2 of the sum of the odds in sharing[n] and sharing[n - 1]. With these
    // precomputed sums, the loop below needs only half as many calls to add_log2.
    std::array<int, kMaxShared + kMaxLines> pairs;
    std::fill_n(sharing.begin(), kMaxShared, kNever_q8);
    std::fill_n(pairs.begin(), kMaxShared, kNever_q8);
    std::size_t newest = kMaxShared;
    sharing[newest] = pairs[newest] = 0;
    int apart = odds[0].sum_q8;
    int sum = 0;
    for (int line = 0;;) {
        sum = add_log2(apart, sharing[newest + 1 - max_shared]);
        for (std::size_t n = 0; n + 1 < max_shared; n += 2)
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

/// Returns an upper bound on the odds of the far alternatives that share at most seven lines, as
/// log2 in units of 2^-8. Covers all sets. An alternative that shares at most seven lines loses at
/// least the sum of all minimum losses except the seven largest. The bound is the product of these
/// factors:
/// - the odds at this loss,
/// - four times the number of alternatives in the largest set, which is more than the total number
///   of alternatives in all sets,
/// - the number of possible rolls of the first line,
/// - the safety factor `kUnevenness`, once per line,
/// - 2^lines, which bounds the number of ways to choose the shared lines.
int sharing_few_log2_q8(const LikelihoodRatios& ratios) {
    constexpr std::size_t kFew = 7;
    std::array<int, kFew> largest{};  // the largest losses, in decreasing order
    int lost = 0;
    for (int line = 0; line < ratios.count(); ++line) {
        int loss = ratios.min_loss(line);
        lost += loss;
        for (int& greater : largest) {
            if (loss > greater) std::swap(loss, greater);
        }
    }
    for (const int loss : largest)
        lost -= loss;
    constexpr int kSets_q8 = 2 * 256;
    return kAlternativeSets.back().alternatives_q8 + kSets_q8 + kOtherRolls_q8 +
           (256 + kUnevenness_q8) * ratios.count() + ratios.log2_odds_q8(lost);
}

/// Returns an upper bound on the odds of the far alternatives in all sets, as log2 in units of
/// 2^-8. If `roughly` is true, replaces the summed odds of the other rolls of a line with an upper
/// bound: the number of these rolls times the best odds. For hard bits, always uses the bound of
/// `LikelihoodRatios::log2_of_nearest_q8`. Stops when the sum exceeds `max_log2_q8`. The result is
/// then not an upper bound.
int far_log2_q8(const LikelihoodRatios& ratios, bool roughly, int max_log2_q8) {
    AllLineOdds odds;
    odds[0] = {};
    for (int line = 0; line < ratios.count(); ++line) {
        const int best = ratios.log2_odds_q8(ratios.min_loss(line));
        const int others = ratios.is_of_bits() ? ratios.log2_of_nearest_q8(line)
                           : roughly           ? kOtherRolls_q8
                                               : log2_of_others_q8(ratios, line);
        odds[static_cast<std::size_t>(line)] = {best, best + others};
    }
    int sum = far_log2_q8(ratios, kAlternativeSets.front(), odds);
    // Each of the other four sets contains more alternatives, but these alternatives share fewer
    // lines on average. If only alternatives that share more than seven lines are counted, the
    // summed odds of each of these four sets are less than half the summed odds of the first set.
    // The summed odds of all five sets are therefore less than three times those of the first set.
    constexpr int kThreeTimes_q8 = 406;
    if (sum + kThreeTimes_q8 < kSmallOdds_q8) {
        const int with_others = add_log2(sum + kThreeTimes_q8, sharing_few_log2_q8(ratios));
        if (with_others < kSmallOdds_q8) return with_others;
    }
    for (const AlternativeSet& set : std::span(kAlternativeSets).subspan(1)) {
        if (sum > max_log2_q8) break;
        sum = add_log2(sum, far_log2_q8(ratios, set, odds));
    }
    return sum;
}

/// Sums the odds of single alternatives at every shift where the loss may be below `loss_limit`.
class ByShift {
  public:
    ByShift(const LikelihoodRatios& ratios, int loss_limit);

    /// Returns `sum` plus the odds of the single alternative at `place` in `sequence`. `sum` and
    /// the result are log2 in units of 2^-8.
    int add(std::size_t sequence, std::uint32_t place, int sum) {
        if (sequence != sequence_) begin(sequence);
        return may_matter(rolls_ + place) ? add_closely(place, sum) : sum;
    }

  private:
    struct Loss {
        std::uint16_t min_loss;  ///< minimum loss if the line is not shared
        std::uint8_t line;
        /// Contribution of the sequence to the roll of the line, at the place of the reading.
        std::uint8_t own = 0;
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
    std::uint32_t loss_limit_;
    std::size_t count_ = 0;               ///< number of lines with a positive minimum loss
    std::array<Loss, kMaxLines> losses_;  ///< losses of these lines, in decreasing order
    std::uint32_t in_all_ = 0;            ///< total of all losses
    /// Number of elements of `losses_` that `may_matter` adds before its first check, and the sum
    /// of these losses. An earlier check could not reject any alternative that shares the first of
    /// these lines, because such an alternative loses less than `loss_limit_` in the other lines.
    std::size_t first_count_ = 0;
    std::uint32_t first_losses_ = 0;
    /// For each shift, `none_` plus the losses that the current alternative avoids by sharing
    /// lines. Values below `none_` belong to earlier alternatives and are treated as `none_`.
    std::array<std::uint32_t, kSections> kept_{};
    /// Value in `kept_` at shifts where the alternative avoids no losses. Increasing `none_` for
    /// each alternative resets `kept_` without writing to it.
    std::uint32_t none_;
};

ByShift::ByShift(const LikelihoodRatios& ratios, int loss_limit)
    : ratios_(ratios), loss_limit_(static_cast<std::uint32_t>(loss_limit)), none_(loss_limit_) {
    for (int line = 0; line < ratios.count(); ++line) {
        if (ratios.min_loss(line) <= 0) continue;
        const auto min_loss = static_cast<std::uint16_t>(ratios.min_loss(line));
        std::size_t i = count_++;
        for (; i > 0 && losses_[i - 1].min_loss < min_loss; --i)
            losses_[i] = losses_[i - 1];
        losses_[i] = {min_loss, static_cast<std::uint8_t>(line)};
        in_all_ += min_loss;
    }
    while (first_count_ < count_) {
        const std::uint32_t with_next = first_losses_ + losses_[first_count_].min_loss;
        if (with_next >= loss_limit_ + losses_[0].min_loss) break;
        first_losses_ = with_next;
        ++first_count_;
    }
}

/// Returns true if an alternative may lose less than `loss_limit_` at some shift. `alternative`
/// points to the rolls of the sequence at the place of the alternative.
// Not inlined, because small processors have too few registers for the combined loops.
[[gnu::noinline]] bool ByShift::may_matter(const std::uint8_t* alternative) {
    std::uint32_t* const kept = kept_.data();
    const std::uint32_t none = none_ += in_all_;
    std::uint32_t largest = none;
    const auto keep = [&](const Loss& loss) {
        const int difference = alternative[loss.line] - loss.own;
        const int shift = difference < 0 ? difference + kSections : difference;
        const std::uint32_t now = std::max(kept[shift], none) + loss.min_loss;
        kept[shift] = now;
        largest = std::max(largest, now);
    };
    const Loss* loss = losses_.data();
    for (const Loss* const end = loss + first_count_; loss != end; ++loss)
        keep(*loss);
    // If `largest` is at most this value, the alternative loses at least `loss_limit_` at every
    // shift, even if only the lines added so far are considered. Its odds are then negligible.
    std::uint32_t max_to_keep = none - loss_limit_ + first_losses_;
    for (const Loss* const end = losses_.data() + count_; loss != end; ++loss) {
        keep(*loss);
        max_to_keep += loss->min_loss;
        if (largest <= max_to_keep) return false;
    }
    return true;
}

/// Returns `sum` plus the odds of a place at all shifts where its loss may be below `loss_limit_`.
/// Evaluates these odds line by line. Not inlined, because small processors have too few registers
/// for the combined loops.
[[gnu::noinline]] int ByShift::add_closely(std::uint32_t place, int sum) const {
    RollOffsets offsets;
    set_roll_offsets(ratios_, sequence_, place, offsets);
    // kept[s] is the loss that the alternative avoids at shift s: the sum of the minimum losses of
    // the lines that it shares at this shift.
    std::array<std::uint32_t, kSections> kept;
    for (int line = 0; line < ratios_.count(); ++line)
        kept[offsets[static_cast<std::size_t>(line)]] = 0;
    for (std::size_t i = 0; i < count_; ++i)
        kept[offsets[static_cast<std::size_t>(losses_[i].line)]] += losses_[i].min_loss;
    for (int line = 0; line < ratios_.count(); ++line) {
        std::uint32_t& here = kept[offsets[static_cast<std::size_t>(line)]];
        if (in_all_ - here < loss_limit_) {
            const std::optional<int> lost = loss_of_offsets(ratios_, offsets, line);
            const int odds = lost ? ratios_.log2_odds_q8(*lost) : kNever_q8;
            if (odds > kSkippedOdds_q8) sum = add_log2(sum, odds);
        }
        // Lines that are shared at the same shift belong to the same alternative, which is counted
        // only once.
        here = 0;
    }
    return sum;
}

/// Returns an upper bound on the odds of the single alternatives in one sequence that share a line,
/// as log2 in units of 2^-8. Assumes that each alternative has the minimum loss for the sequence.
/// An alternative is counted once for each shift at which it shares a line. There are at most
/// `ratios.count()` such shifts.
int by_table_log2_q8(const LikelihoodRatios& ratios, const UnsharedLines& unshared,
                     std::size_t sequence) {
    const int lost = unshared.min_loss(sequence, Sharing::at_one_shift) - ratios.max_gain();
    const int alternatives = ratios.count() * static_cast<int>(ratios.basis[sequence].length);
    return log2_at_most_q8(static_cast<std::uint32_t>(alternatives)) +
           ratios.log2_odds_q8(std::max(lost, 0));
}

/// Set of sequences, one bit per sequence.
using Sequences = unsigned;
constexpr Sequences kAllSequences = 15;

/// For each of the given sequences, computes bounds from the tables (see `by_table_log2_q8`), and
/// adds the first bound below `little_q8` to `sum`. Tries the table for the most lines first.
/// Returns the sequences for which no table gives such a bound.
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

/// Returns an upper bound on the odds of the single alternatives in the given sequences that share
/// a line, as log2 in units of 2^-8. Most alternatives contribute only kSkippedOdds_q8 for each
/// line. Individual odds are computed only for the few alternatives that may have larger odds.
int singles_log2_q8(const LikelihoodRatios& ratios, Sequences sequences) {
    const int lines = ratios.count();
    const int loss_limit = ratios.loss_for(kSkippedOdds_q8) + ratios.max_gain();
    int sum = kSingles_q8 + kSkippedOdds_q8 +
              256 * static_cast<int>(std::bit_width(static_cast<unsigned>(lines)));
    if (min_losses(ratios, false)[static_cast<std::size_t>(lines)] >= loss_limit) return sum;
    ByShift by_shift(ratios, loss_limit);
    const UnsharedLines unshared(ratios);
    visit_similar_places(
        ratios, Steps(ratios, loss_limit, Excused::none),
        [&](std::size_t sequence) {
            return (sequences >> sequence & 1) == 0 ||
                   unshared.all_lose(sequence, Sharing::at_one_shift, loss_limit);
        },
        [&](std::size_t sequence, std::uint32_t place) {
            sum = by_shift.add(sequence, place, sum);
        });
    return sum;
}

/// Returns an upper bound on the odds of the reading's position in all other sections, as log2 in
/// units of 2^-8. In these sections, no line has the roll of the reading.
int other_sections_log2_q8(const LikelihoodRatios& ratios) {
    return kOtherRolls_q8 + ratios.log2_odds_q8(ratios.min_loss_of_all());
}

}  // namespace

int quick_alternatives_log2_q8(const LikelihoodRatios& ratios, int limit_q8) {
    // There is no tighter bound for hard bits, so the summation stops only if the sum exceeds the
    // caller's limit.
    const bool is_last = ratios.is_of_bits();
    int far = far_log2_q8(ratios, true, is_last ? limit_q8 : kSmallOdds_q8);
    if (far > kSmallOdds_q8 && !is_last) far = far_log2_q8(ratios, false, limit_q8);
    const int other_sections = other_sections_log2_q8(ratios);
    const int sum = add_log2(other_sections, far);
    if (sum >= limit_q8) return 0;
    Sequences sequences = kAllSequences;
    int singles = kNever_q8;
    if (is_last) {
        // Tries the bounds from the tables first. They are looser than a sum over all places, but
        // much faster to compute.
        constexpr int kLittle_q8 = -5 * 256;
        const int little_q8 = std::min(limit_q8, kUsualLimit_q8) + kLittle_q8;
        sequences = add_by_tables(ratios, little_q8, sequences, singles);
        // Adds the single alternatives at shifts without a shared line. Like the reading's position
        // in another section, they lose at least `min_loss` in each line. At each place, their
        // summed odds over all of these shifts are therefore at most the bound for the other
        // sections.
        singles = add_log2(singles, kSingles_q8 + other_sections);
    }
    if (sequences != 0) singles = add_log2(singles, singles_log2_q8(ratios, sequences));
    return std::min(add_log2(sum, singles), 0);
}

}  // namespace dotpose::core
