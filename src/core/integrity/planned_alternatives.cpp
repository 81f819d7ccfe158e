#include "core/integrity/planned_alternatives.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "core/integrity/line_sets.hpp"
#include "core/integrity/set_plan.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// Safety factor for the expected odds of the sets that are not searched. On 2,500 axes of nominal
/// frames, the ratio of the true odds of these sets to the expected odds was 0.04 on average, above
/// 4 on 6 axes, and at most 40.
constexpr float kPlanMargin = 4;

/// If the loss of an alternative reaches this number of bits, its evaluation stops. The alternative
/// then contributes the odds at this loss.
constexpr int kSkippedBits = 46;

/// The key of a place consists of the changes of the roll offset across the first two gaps,
/// combined as kKeyStep * first + second. The sum of two keys is less than kKeys, because both
/// parts of a key are below kSections.
constexpr std::size_t kKeyStep = 128;
constexpr std::size_t kKeys = 2 * kKeyStep * kSections;

/// A set of shared lines, and the lines that are not shared, sorted by decreasing minimum loss.
struct Pattern {
    Pattern(const RankedLines& lines, LineSet shared_) : shared(shared_), gaps(shared_) {
        for (int line = 0; line < lines.count(); ++line) {
            if ((shared >> line & 1) != 0) continue;
            std::size_t n = unshared_count++;
            for (; n > 0 && lines.ratios.min_loss(unshared[n - 1]) < lines.ratios.min_loss(line);
                 --n)
                unshared[n] = unshared[n - 1];
            unshared[n] = static_cast<std::uint8_t>(line);
        }
        packed_count = std::min(unshared_count, sizeof(std::uint64_t));
    }
    LineSet shared;
    Gaps gaps;
    std::size_t unshared_count = 0;
    std::size_t packed_count;  ///< number of lines whose offsets are packed (`KeyedPlaces::packed`)
    std::array<std::uint8_t, kMaxLines> unshared;
};

/// Places in one sequence at which an alternative may share a given set of lines.
class KeyedPlaces {
  public:
    /// Lists the places. If `negates` is true, computes the keys from the negated changes.
    void list(const RankedLines& lines, std::size_t sequence, const PlaceBits& places,
              const Pattern& pattern, bool negates) {
        count_ = 0;
        for (std::size_t word = 0; word < places.size(); ++word) {
            for (std::uint32_t rest = places[word]; rest != 0; rest &= rest - 1) {
                const auto place = static_cast<std::uint32_t>(
                    32 * word + static_cast<std::size_t>(std::countr_zero(rest)));
                lines.set_offsets(sequence, place, offsets_[count_]);
                is_other_[count_] = place != lines.ratios.places[sequence] ? 1 : 0;
                set_key(pattern.gaps, negates);
                make_relative(static_cast<std::size_t>(lines.count()), pattern.gaps.before[0],
                              offsets_[count_]);
                pack(pattern);
                ++count_;
            }
        }
    }
    std::size_t count() const { return count_; }
    /// Returns the roll offsets of a place relative to the first shared line.
    const RollOffsets& offsets(std::size_t n) const { return offsets_[n]; }
    /// Returns the roll offsets in the first eight lines that are not shared, one per byte. Sums of
    /// four such offsets fit in a byte.
    std::uint64_t packed(std::size_t n) const { return packed_[n]; }
    std::size_t key(std::size_t n) const { return keys_[n]; }
    /// Returns 1 if the place is not the place of the reading, and 0 otherwise.
    int is_other(std::size_t n) const { return is_other_[n]; }

  private:
    void set_key(const Gaps& gaps, bool negates) {
        const RollOffsets& offsets = offsets_[count_];
        const auto across = [&](std::size_t gap) -> std::size_t {
            const std::uint8_t before = offsets[static_cast<std::size_t>(gaps.before[gap])];
            const std::uint8_t after = offsets[static_cast<std::size_t>(gaps.after[gap])];
            return negates ? roll_offset(after, before) : roll_offset(before, after);
        };
        keys_[count_] = static_cast<std::uint16_t>(kKeyStep * across(0) + across(1));
    }
    void pack(const Pattern& pattern) {
        std::uint64_t packed = 0;
        for (std::size_t n = pattern.packed_count; n-- > 0;)
            packed = packed << 8 | offsets_[count_][pattern.unshared[n]];
        packed_[count_] = packed;
    }

    static constexpr std::size_t kMaxPlaces = code::kA4Restored.size();

    std::size_t count_ = 0;
    std::array<std::uint8_t, kMaxPlaces> is_other_;
    std::array<std::uint16_t, kMaxPlaces> keys_;
    std::array<std::uint64_t, kMaxPlaces> packed_;
    std::array<RollOffsets, kMaxPlaces> offsets_;
};

/// Finds the far alternatives that share given sets of lines, and adds their odds. For each set,
/// lists the places in each sequence at which an alternative may share these lines (see
/// EqualPlaces). The search builds a table of all pairs of places in two of the sequences. The key
/// of a pair contains the changes of the roll offset across the gaps between the shared lines. For
/// each pair of places in the other two sequences, the search looks up the pairs with the opposite
/// changes.
class SetSearch {
  public:
    SetSearch(const RankedLines& lines, float max_odds, WorkLimit& work)
        : lines_(lines),
          count_(static_cast<std::size_t>(lines.count())),
          max_odds_(max_odds),
          skipped_loss_(lines.ratios.loss_for(-256 * kSkippedBits) + lines.ratios.max_gain()),
          work_(work),
          equal_places_(lines) {
        newest_.fill(kNone);
    }

    /// Adds the odds of the far alternatives that share exactly the lines `shared`, which must not
    /// be empty. Lines without a positive minimum loss may or may not be shared. Returns false if
    /// the search must end, because the sum exceeds `max_odds` or the work does not suffice.
    bool add(LineSet shared) {
        PlaceSets places = equal_places_.all();
        for (LineSet steps = shared & shared >> 1; steps != 0; steps &= steps - 1)
            equal_places_.keep_equal(static_cast<std::size_t>(std::countr_zero(steps)), places);
        if (equal_places_.count_different(places) < 2) return work_.spend(kWorkPerSet);
        const Pattern pattern(lines_, shared);
        if (!list(places, pattern)) return false;
        add_matches(pattern);
        return odds() <= max_odds_;
    }
    float odds() const {
        return sum_ + static_cast<float>(skipped_) * power_of_two_exactly(-kSkippedBits);
    }

  private:
    static constexpr std::size_t kWorkPerSet = 1000;
    /// A pair of places is stored as kPlaces times the index in a3 plus the index in a1.
    static constexpr std::size_t kPlaces = 256;
    static constexpr std::size_t kMaxPairs = code::kA3.size() * kPlaces;
    static constexpr std::uint16_t kNone = kMaxPairs;
    static_assert(code::kA1.size() <= kPlaces);

    /// Lists the places in all sequences. Returns false if the work does not suffice.
    bool list(const PlaceSets& places, const Pattern& pattern) {
        for (std::size_t k = 0; k < places.size(); ++k)
            lists_[k].list(lines_, k, places[k], pattern, k % 2 == 1);
        const std::size_t tabled = lists_[0].count() * lists_[2].count();
        const std::size_t looked_up = lists_[1].count() * lists_[3].count();
        std::size_t listed = 0;
        for (const KeyedPlaces& list : lists_)
            listed += list.count();
        std::size_t matches = tabled * looked_up;
        for (std::size_t gap = 0; gap < pattern.gaps.count; ++gap)
            matches /= kSections;
        return work_.spend(kWorkPerSet + 80 * listed + 36 * tabled + 9 * looked_up + 45 * matches);
    }

    /// Combines each pair of places in a2 and a4 with all pairs of places in a1 and a3 that make
    /// the roll offset equal at both ends of each gap.
    void add_matches(const Pattern& pattern) {
        int rest = 0;  // minimum loss in the packed lines after line n
        for (std::size_t n = pattern.packed_count; n-- > 0;) {
            losses_[n] = lines_.losses(pattern.unshared[n]);
            limits_[n] = skipped_loss_ - rest;
            rest += std::max(lines_.ratios.min_loss(pattern.unshared[n]), 0);
        }
        const auto& [first, second, third, fourth] = lists_;
        for (std::size_t n = 0; n < third.count(); ++n) {
            for (std::size_t m = 0; m < first.count(); ++m) {
                const auto pair = static_cast<std::uint16_t>(kPlaces * n + m);
                const std::size_t key = reduced(third.key(n) + first.key(m));
                before_[pair] = newest_[key];
                set_newest(key, pair);
            }
        }
        for (std::size_t n = 0; n < second.count(); ++n) {
            for (std::size_t m = 0; m < fourth.count(); ++m) {
                const std::size_t key = second.key(n) + fourth.key(m);
                for (std::uint16_t pair = newest_[key]; pair != kNone; pair = before_[pair])
                    add(pattern, pair % kPlaces, n, pair / kPlaces, m);
            }
        }
        for (std::size_t n = 0; n < third.count(); ++n) {
            for (std::size_t m = 0; m < first.count(); ++m)
                set_newest(reduced(third.key(n) + first.key(m)), kNone);
        }
    }
    /// Reduces both parts of a key modulo kSections.
    static std::size_t reduced(std::size_t key) {
        constexpr std::size_t kTooMany = kKeyStep * kSections;
        if (key % kKeyStep >= kSections) key -= kSections;
        return key >= kTooMany ? key - kTooMany : key;
    }
    /// Sets the elements of `newest_` for all keys that are equal to `key` after both parts are
    /// reduced modulo kSections.
    void set_newest(std::size_t key, std::uint16_t pair) {
        newest_[key] = newest_[key + kSections] = pair;
        newest_[key + kKeyStep * kSections] = newest_[key + kKeyStep * kSections + kSections] =
            pair;
    }

    /// Adds the odds of the alternative with the given places, at the shift where it shares the
    /// first shared line. Most alternatives lose kSkippedBits in the first few lines, and count as
    /// skipped. The arguments are indices into the lists of places.
    void add(const Pattern& pattern, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        std::uint64_t shifts =
            lists_[0].packed(a) + lists_[1].packed(b) + lists_[2].packed(c) + lists_[3].packed(d);
        int lost = 0;
        for (std::size_t n = 0; n < pattern.packed_count; ++n, shifts >>= 8) {
            lost += losses_[n][shifts & 0xFF];
            if (lost >= limits_[n]) {
                ++skipped_;
                return;
            }
        }
        if (lists_[0].is_other(a) + lists_[1].is_other(b) + lists_[2].is_other(c) +
                lists_[3].is_other(d) >=
            2)
            add_in_all_lines(pattern, a, b, c, d);
    }

    /// Adds the odds of the alternative with the given places. Adds nothing if, among the lines
    /// with a positive minimum loss, it does not share exactly the lines of the pattern.
    void add_in_all_lines(const Pattern& pattern, std::size_t a, std::size_t b, std::size_t c,
                          std::size_t d) {
        int lost = 0;
        for (std::size_t line = 0; line < count_; ++line) {
            const int shift = lists_[0].offsets(a)[line] + lists_[1].offsets(b)[line] +
                              lists_[2].offsets(c)[line] + lists_[3].offsets(d)[line];
            const bool is_compared = lines_.ratios.min_loss(static_cast<int>(line)) > 0;
            if (is_compared && (shift % kSections == 0) != ((pattern.shared >> line & 1) != 0))
                return;
            lost += lines_.loss(static_cast<int>(line), shift);
        }
        sum_ += lines_.ratios.odds(lost);
    }

    const RankedLines& lines_;
    std::size_t count_;
    float max_odds_;
    int skipped_loss_;  ///< kSkippedBits as a loss, plus the maximum gain in other lines
    WorkLimit& work_;
    EqualPlaces equal_places_;
    std::array<KeyedPlaces, 4> lists_;
    /// Losses in the first lines that are not shared, by roll offset (see `RankedLines::losses`).
    std::array<const std::int16_t*, sizeof(std::uint64_t)> losses_{};
    /// For each of these lines, the loss limit. An alternative is skipped if its total loss in the
    /// lines up to and including this line reaches the limit.
    std::array<int, sizeof(std::uint64_t)> limits_{};
    /// `newest_` contains the newest pair of places with each key, and `before_` contains for each
    /// pair the previous pair with the same key.
    std::array<std::uint16_t, kKeys> newest_;
    std::array<std::uint16_t, kMaxPairs> before_;
    std::size_t skipped_ = 0;  ///< number of skipped alternatives
    float sum_ = 0;
};

}  // namespace

std::optional<float> sum_of_planned_alternatives(const RankedLines& lines, float max_rest,
                                                 float max_odds, WorkLimit& work) {
    const SetPlan plan(lines, max_rest / kPlanMargin, static_cast<float>(work.left()));
    if (!plan.is_feasible()) return {};
    SetSearch search(lines, max_odds, work);
    for (const PlannedSet& set : plan.sets()) {
        if (search.add(set.shared)) continue;
        return search.odds() > max_odds ? std::optional(search.odds()) : std::nullopt;
    }
    return search.odds() + kPlanMargin * plan.rest();
}

}  // namespace dotpose::core
