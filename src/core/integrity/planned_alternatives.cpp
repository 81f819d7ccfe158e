#include "core/integrity/planned_alternatives.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>

#include "core/integrity/line_sets.hpp"
#include "core/integrity/set_plan.hpp"
#include "core/integrity/similar_places.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// Safety factor for the expected odds of the sets that are not searched. Summed over 3,798 axes of
/// nominal frames, the true odds of these sets were 0.03 times the expected odds. On single axes,
/// the ratio was at most 9, and exceeded 4 on only 6 axes.
constexpr float kPlanMargin = 4;

/// Upper limit on kPlanMargin * (expected odds of the sets that are not searched), as log2. Keeps
/// the result precise if the sum so far is far below the caller's limit.
constexpr int kMaxRest_log2 = -31;

/// Number of lost bits beyond which an alternative is not evaluated further. If the loss in the
/// packed lines shows that the total loss is at least this large, the alternative contributes the
/// odds at this loss.
constexpr int kSkippedBits = 46;

/// The key of a place is kKeyStep * first + second. `first` and `second` are the roll offsets
/// directly after the first gap and directly after the second gap, relative to the first shared
/// line.
constexpr std::uint32_t kKeyStep = 128;
constexpr std::uint32_t kKeys = kKeyStep * (kSections + 1);

/// Adds both offsets of two keys modulo kSections. The offsets of the result are one larger: they
/// are in [1, kSections].
constexpr std::uint32_t sum_of_keys(std::uint32_t a, std::uint32_t b) {
    constexpr std::uint32_t kOnes = kKeyStep + 1;
    // Each offset of this sum is in [1, 125]. Because 64 is 1 modulo 63, adding bit 6 to the other
    // bits reduces the offset.
    const std::uint32_t sum = a + b + kOnes;
    return (sum & kSections * kOnes) + (sum >> 6 & kOnes);
}
static_assert(kSections == 63);

/// Number of packed lines. Their roll offsets are packed into one word. For each alternative,
/// `SetSearch` first computes the loss in these lines alone.
constexpr std::size_t kPackedLines = 4;

/// A set of shared lines, and the packed lines: the unshared lines with the largest minimum losses.
struct Pattern {
    /// `sorted` contains all lines in order of decreasing minimum loss.
    Pattern(const LossTables& lines, std::span<const std::uint8_t> sorted, LineSet shared_)
        : shared(shared_), gaps(shared_) {
        losses.fill(kNoLosses.data());
        std::size_t n = 0;
        for (const std::uint8_t line : sorted) {
            if ((shared >> line & 1) != 0) continue;
            unshared[n] = line;
            losses[n] = lines.losses(line);
            if (++n == kPackedLines) break;
        }
    }
    /// Returns the roll offsets in the packed lines, one per byte. Sums of four offsets fit in a
    /// byte, so the words of four sequences can be added.
    std::uint32_t packed(const RollOffsets& offsets) const {
        const auto& [a, b, c, d] = unshared;
        return offsets[a] | std::uint32_t{offsets[b]} << 8 | std::uint32_t{offsets[c]} << 16 |
               std::uint32_t{offsets[d]} << 24;
    }
    /// Returns the total loss in the packed lines. `packed` is the sum of the packed roll offsets
    /// in the four sequences.
    int lost(std::uint32_t packed) const {
        return losses[0][packed & 0xFF] + losses[1][packed >> 8 & 0xFF] +
               losses[2][packed >> 16 & 0xFF] + losses[3][packed >> 24];
    }

    LineSet shared;
    Gaps gaps;

  private:
    static constexpr std::array<std::int16_t, 256> kNoLosses{};

    std::array<std::uint8_t, kPackedLines> unshared{};
    /// Losses in the packed lines, by roll offset (see `LossTables::losses`). If fewer than
    /// kPackedLines lines are unshared, the remaining elements point to kNoLosses.
    std::array<const std::int16_t*, kPackedLines> losses;
};

/// Places in one sequence at which an alternative may share a given set of lines.
class KeyedPlaces {
  public:
    /// Lists the places. If `negates` is true, computes their keys from negated roll offsets.
    void list(const LossTables& lines, std::size_t sequence, const PlaceBits& places,
              const Pattern& pattern, bool negates) {
        const Gaps& gaps = pattern.gaps;
        const RelativeOffsets set_offsets(lines.ratios, sequence, gaps.before[0]);
        std::size_t n = 0;
        visit_places(places, [&](std::uint32_t place) {
            places_[n] = static_cast<std::uint8_t>(place);
            RollOffsets& offsets = offsets_[n];
            set_offsets(place, offsets);
            const auto change = [&](std::size_t gap) -> std::size_t {
                const std::size_t offset = offsets[static_cast<std::size_t>(gaps.after[gap])];
                return negates && offset != 0 ? kSections - offset : offset;
            };
            keys_[n] = static_cast<std::uint16_t>(kKeyStep * change(0) + change(1));
            packed_[n++] = pattern.packed(offsets);
        });
        count_ = n;
    }
    std::size_t count() const { return count_; }
    std::uint8_t place(std::size_t n) const { return places_[n]; }
    /// Returns the roll offsets of a place relative to the first shared line.
    const RollOffsets& offsets(std::size_t n) const { return offsets_[n]; }
    std::span<const std::uint16_t> keys() const { return std::span(keys_).first(count_); }
    std::uint32_t packed(std::size_t n) const { return packed_[n]; }

  private:
    static constexpr std::size_t kMaxPlaces = code::kA4Restored.size();

    std::size_t count_ = 0;
    std::array<std::uint8_t, kMaxPlaces> places_;
    std::array<std::uint16_t, kMaxPlaces> keys_;
    std::array<std::uint32_t, kMaxPlaces> packed_;
    std::array<RollOffsets, kMaxPlaces> offsets_;
};

/// Finds the far alternatives that share given sets of lines, and adds up their odds. For each set,
/// the search lists the places in each sequence at which an alternative may share these lines (see
/// `EqualPlaces`). The search then builds a table of all pairs of places in a1 and a3. The key of a
/// pair is the sum of the keys of both places. For each pair of places in a2 and a4, the search
/// looks up the pairs in a1 and a3 that cancel the roll offsets of this pair after the first two
/// gaps. Together, the two pairs contain the four places of an alternative that shares the lines at
/// the ends of these gaps.
class SetSearch {
  public:
    SetSearch(const LossTables& lines, int skipped_bits, float max_odds, WorkLimit& work)
        : lines_(lines),
          count_(static_cast<std::size_t>(lines.count())),
          max_odds_(max_odds),
          skipped_odds_(power_of_two_exactly(-skipped_bits)),
          skipped_loss_(lines.ratios.loss_for(-256 * skipped_bits) + lines.ratios.max_gain()),
          work_(work),
          equal_places_(lines) {
        newest_.fill(kNone);
        sort_lines();
    }

    /// Adds the odds of the far alternatives that share all lines of `shared`. Skips alternatives
    /// that share all lines of an earlier set, because they have already been added. Returns false
    /// if the search must end: because the sum exceeds `max_odds`, because the search would exceed
    /// its work limit, or because the set is empty.
    bool add(LineSet shared) {
        if (shared == 0) return false;  // the search for all alternatives takes too long
        earlier_ = searched_.sets();
        if (!searched_.add(shared)) return true;
        PlaceSets places = equal_places_.all();
        for (LineSet steps = shared & shared >> 1; steps != 0; steps &= steps - 1)
            equal_places_.keep_equal(static_cast<std::size_t>(std::countr_zero(steps)), places);
        if (equal_places_.count_different(places) < 2) return spend(0, 0, 0, 0);
        const Pattern pattern(lines_, std::span(sorted_).first(count_), shared);
        if (!list(places, pattern)) return false;
        add_matches(pattern);
        return !is_exhausted_ && odds() <= max_odds_;
    }
    float odds() const { return sum_ + static_cast<float>(skipped_) * skipped_odds_; }

  private:
    /// A pair of places is stored as kPlaces * (index in the list of a3) + (index in the list of
    /// a1).
    static constexpr std::size_t kPlaces = 256;
    static constexpr std::size_t kMaxPairs = code::kA3.size() * kPlaces;
    static constexpr std::uint16_t kNone = kMaxPairs;
    static_assert(code::kA1.size() <= kPlaces && code::kA2.size() <= kPlaces &&
                  code::kA4Restored.size() <= kPlaces);

    struct Pair {
        std::uint32_t packed;  ///< sum of the packed roll offsets
        std::uint16_t before;  ///< next older pair with the same key
        std::uint16_t key;
    };

    /// Places in a2 and a4 whose roll offsets are cancelled by a pair of places in a1 and a3.
    struct Found {
        std::uint16_t pair;
        std::uint8_t n;  ///< index in the list of a2
        std::uint8_t m;  ///< index in the list of a4
    };
    static constexpr std::size_t kMaxFound = 1024;

    void sort_lines() {
        const auto min_loss = [&](std::size_t line) {
            return lines_.ratios.min_loss(static_cast<int>(line));
        };
        const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(count_);
        std::iota(sorted_.begin(), end, std::uint8_t{0});
        std::sort(sorted_.begin(), end, [&](std::uint8_t a, std::uint8_t b) {
            return min_loss(a) != min_loss(b) ? min_loss(a) > min_loss(b) : a < b;
        });
    }

    /// Lists the places in all sequences. Returns false if the search would exceed its work limit.
    bool list(const PlaceSets& places, const Pattern& pattern) {
        for (std::size_t k = 0; k < places.size(); ++k)
            lists_[k].list(lines_, k, places[k], pattern, k % 2 == 1);
        const auto count = [&](std::size_t k) { return static_cast<float>(lists_[k].count()); };
        const float tabled = count(0) * count(2);
        const float looked_up = count(1) * count(3);
        float matches = tabled * looked_up;
        for (std::size_t gap = 0; gap < pattern.gaps.count; ++gap)
            matches /= kSections;
        return spend(count(0) + count(1) + count(2) + count(3), tabled, looked_up, matches);
    }
    bool spend(float listed, float tabled, float looked_up, float matches) {
        constexpr float kMaxWork = 1e9F;  // can be converted to an integer with 32 bits
        const float work = work_of_search(listed, tabled, looked_up, matches);
        return work_.spend(static_cast<std::size_t>(std::min(work, kMaxWork)));
    }

    /// Combines pairs of places in a2 and a4 with pairs of places in a1 and a3. Uses only
    /// combinations whose total roll offset is the same on both sides of the first gap, and the
    /// same on both sides of the second gap.
    void add_matches(const Pattern& pattern) {
        const auto& [first, second, third, fourth] = lists_;
        for (std::size_t n = 0; n < third.count(); ++n) {
            for (std::size_t m = 0; m < first.count(); ++m) {
                const auto pair = static_cast<std::uint16_t>(kPlaces * n + m);
                const std::uint32_t key = sum_of_keys(third.keys()[n], first.keys()[m]);
                pairs_[pair] = {third.packed(n) + first.packed(m), newest_[key],
                                static_cast<std::uint16_t>(key)};
                newest_[key] = pair;
            }
        }
        // First collects the keys that have pairs, because a branch for each key would often be
        // mispredicted.
        std::size_t count = 0;
        for (std::size_t n = 0; n < second.count(); ++n) {
            const std::uint32_t key = second.keys()[n];
            for (std::size_t m = 0; m < fourth.count(); ++m) {
                const std::uint16_t pair = newest_[sum_of_keys(key, fourth.keys()[m])];
                found_[count] = {pair, static_cast<std::uint8_t>(n), static_cast<std::uint8_t>(m)};
                count += pair != kNone ? 1 : 0;
            }
            if (count <= kMaxFound - kPlaces) continue;
            add_found(pattern, count);
            count = 0;
        }
        add_found(pattern, count);
        for (std::size_t n = 0; n < third.count(); ++n) {
            for (std::size_t m = 0; m < first.count(); ++m)
                newest_[pairs_[kPlaces * n + m].key] = kNone;
        }
    }

    /// Adds the alternatives of the first `count` elements of `found_`, and those of all older
    /// pairs with the same keys. Overwrites `found_`.
    void add_found(const Pattern& pattern, std::size_t count) {
        // Each round replaces the pairs by the next older pairs. An inner loop over the pairs of a
        // key would often be mispredicted.
        while (count > 0) {
            std::size_t older = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const auto [index, n, m] = found_[i];
                const Pair& pair = pairs_[index];
                const std::uint32_t packed =
                    pair.packed + lists_[1].packed(n) + lists_[3].packed(m);
                // Most alternatives are skipped.
                if (pattern.lost(packed) >= skipped_loss_)
                    ++skipped_;
                else
                    add(pattern.shared, index % kPlaces, n, index / kPlaces, m);
                found_[older] = {pair.before, n, m};
                older += pair.before != kNone ? 1 : 0;
            }
            count = older;
        }
    }

    /// Adds the odds of the alternative with the given places, at the shift at which it shares the
    /// first line of the set `required`. Adds nothing if the alternative differs in fewer than two
    /// sequences, does not share all lines of `required`, or shares all lines of an earlier set.
    /// `a` to `d` are indices into the lists of places of a1 to a4.
    [[gnu::noinline]] void add(LineSet required, std::size_t a, std::size_t b, std::size_t c,
                               std::size_t d) {
        const auto& own = lines_.ratios.places;
        const int different = (lists_[0].place(a) != own[0]) + (lists_[1].place(b) != own[1]) +
                              (lists_[2].place(c) != own[2]) + (lists_[3].place(d) != own[3]);
        if (different < 2) return;
        RollOffsets offsets;
        LineSet shared = 0;
        for (std::size_t line = 0; line < count_; line += sizeof(Bytes)) {
            // The sum of four offsets fits in a byte.
            const Bytes sum =
                bytes_at(lists_[0].offsets(a), line) + bytes_at(lists_[1].offsets(b), line) +
                bytes_at(lists_[2].offsets(c), line) + bytes_at(lists_[3].offsets(d), line);
            const Bytes offset =
                modulo_sections(sum - (static_cast<Bytes>(sum >= 2 * kSections) & 2 * kSections));
            std::memcpy(offsets.data() + line, &offset, sizeof offset);
            shared |= shared_lines(offset) << line;
        }
        const auto shares = [&](LineSet set) { return (shared & set) == set; };
        if (!shares(required)) return;
        // Estimated cost of an added alternative, in units of `WorkLimit`.
        constexpr std::size_t kWorkPerAdded = 120;
        if (!work_.spend(kWorkPerAdded + 2 * earlier_.size())) {
            is_exhausted_ = true;
            return;
        }
        for (const LineSet set : earlier_) {
            if (shares(set)) return;
        }
        int lost = 0;
        for (std::size_t line = 0; line < count_; ++line)
            lost += lines_.losses(line)[offsets[line]];
        sum_ += lines_.ratios.odds(lost);
    }

    const LossTables& lines_;
    std::size_t count_;
    float max_odds_;
    float skipped_odds_;  ///< odds that a skipped alternative contributes
    /// An alternative is skipped if its loss in the packed lines is at least this value. Its total
    /// loss is then at least `skipped_bits`, even if all other lines have their maximum gain.
    int skipped_loss_;
    WorkLimit& work_;
    EqualPlaces equal_places_;
    SearchedSets searched_;
    std::span<const LineSet> earlier_;            ///< searched sets before the current set
    std::array<std::uint8_t, kMaxLines> sorted_;  ///< lines in order of decreasing minimum loss
    std::array<KeyedPlaces, 4> lists_;
    /// Linked lists of pairs of places, one list for each key. `newest_` contains the newest pair
    /// for each key.
    std::array<std::uint16_t, kKeys> newest_;
    std::array<Pair, kMaxPairs> pairs_;
    std::array<Found, kMaxFound> found_;
    std::size_t skipped_ = 0;    ///< number of skipped alternatives
    bool is_exhausted_ = false;  ///< true if the work limit was reached
    float sum_ = 0;
};

}  // namespace

float work_of_planned_alternatives(const SetPlan& plan, float max_rest) {
    return plan.work_of(plan.count_for(max_rest / kPlanMargin));
}

std::optional<float> sum_of_planned_alternatives(const LossTables& lines, const SetPlan& plan,
                                                 int extra_bits, float fraction, float max_odds,
                                                 WorkLimit& work) {
    const float max_rest = power_of_two_exactly(kMaxRest_log2 - extra_bits);
    SetSearch search(lines, kSkippedBits + extra_bits, max_odds, work);
    const std::span<const PlannedSet> sets = plan.sets();
    for (std::size_t n = 0;; ++n) {
        const float rest = kPlanMargin * plan.rest(n);
        const bool may_end = n == sets.size() || !sets[n].is_required;
        if (may_end && rest <= std::min(fraction * (max_odds - search.odds()), max_rest))
            return search.odds() + rest;
        if (n == sets.size()) return {};
        if (!search.add(sets[n].shared)) return {};
    }
}

}  // namespace dotpose::core
