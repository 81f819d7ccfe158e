#include "core/integrity/likely_alternatives.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "core/integrity/expected_alternatives.hpp"
#include "core/integrity/line_sets.hpp"

namespace dotpose::core {
namespace {

/// Places in one sequence at which an alternative may share a given set of lines.
class PlaceList {
  public:
    void list(const PlaceBits& places) {
        count_ = 0;
        for (std::size_t word = 0; word < places.size(); ++word) {
            for (std::uint32_t rest = places[word]; rest != 0; rest &= rest - 1) {
                places_[count_++] = static_cast<std::uint8_t>(
                    32 * word + static_cast<std::size_t>(std::countr_zero(rest)));
            }
        }
    }
    /// Computes the roll offsets and keys of the listed places.
    void set_offsets(const RankedLines& lines, std::size_t sequence, const Gaps& gaps) {
        const RelativeOffsets set_relative(lines.ratios, sequence, gaps.before[0]);
        for (std::size_t n = 0; n < count_; ++n) {
            RollOffsets& offsets = offsets_[n];
            set_relative(places_[n], offsets);
            const auto across = [&](std::size_t gap) {
                return roll_offset(offsets[static_cast<std::size_t>(gaps.before[gap])],
                                   offsets[static_cast<std::size_t>(gaps.after[gap])]);
            };
            keys_[n] = static_cast<std::uint16_t>(64 * across(0) + across(1));
        }
    }
    std::size_t count() const { return count_; }
    std::uint8_t place(std::size_t n) const { return places_[n]; }
    /// Returns the roll offsets of a place relative to the first shared line.
    const RollOffsets& offsets(std::size_t n) const { return offsets_[n]; }
    /// Returns the key of a place: the changes in its roll offset across the first two gaps between
    /// shared lines (see `Gaps`), combined as 64 * first + second.
    unsigned key(std::size_t n) const { return keys_[n]; }

  private:
    static constexpr std::size_t kMaxPlaces = code::kA4Restored.size();

    std::size_t count_ = 0;
    std::array<std::uint8_t, kMaxPlaces> places_;
    std::array<std::uint16_t, kMaxPlaces> keys_;
    std::array<RollOffsets, kMaxPlaces> offsets_;
};

constexpr unsigned kKeys = 64 * kSections;

/// Returns the key of a combination of two places in different sequences, from the keys `a` and `b`
/// of these places.
unsigned sum_of_keys(unsigned a, unsigned b) {
    unsigned sum = a + b;
    if (a % 64 + b % 64 >= kSections) sum -= kSections;
    return sum >= kKeys ? sum - kKeys : sum;
}
/// Returns the inverse of `key`: `sum_of_keys(key, opposite(key))` is 0.
unsigned opposite(unsigned key) {
    const unsigned first = key / 64;
    const unsigned second = key % 64;
    return 64 * (first == 0 ? 0 : kSections - first) + (second == 0 ? 0 : kSections - second);
}

/// Finds the likely alternatives. Visits all sets of lines whose minimum losses add up to less than
/// the loss limit. Each set contains the lines that an alternative does not share. For each set,
/// lists the places in each sequence at which an alternative may share all lines outside the set
/// (see EqualPlaces). Then adds the odds of the alternatives that share exactly the lines outside
/// the set.
class Finder {
  public:
    Finder(const RankedLines& lines, int loss_limit, float max_odds)
        : lines_(lines),
          count_(lines.count()),
          loss_limit_(loss_limit),
          max_odds_(max_odds),
          equal_places_(lines) {
        newest_.fill(kNone);
    }

    std::optional<float> sum() {
        const bool is_complete = visit(0, 0, equal_places_.all(), 0);
        return is_complete || sum_ > max_odds_ ? std::optional(sum_) : std::nullopt;
    }
    /// Returns the smallest sum of minimum losses among the sets of lines that `sum` skipped. The
    /// result is at least the loss limit.
    int min_skipped_loss() const { return min_skipped_loss_; }

  private:
    /// Maximum estimated cost of the search, in processor instructions.
    static constexpr std::size_t kMaxWork = 2'000'000;
    /// A pair of places in the last two sequences is stored as kLastPlaces times the index of the
    /// first place plus the index of the second place.
    static constexpr std::size_t kLastPlaces = 256;
    static constexpr std::size_t kMaxPairs = code::kA3.size() * kLastPlaces;
    static constexpr std::uint16_t kNone = 0xFFFF;
    static_assert(code::kA4Restored.size() <= kLastPlaces);
    static_assert(kMaxPairs < kNone);

    /// Visits all sets of shared lines that extend `shared`, which contains the shared lines before
    /// `line`. `places` contains the places at which an alternative may share the lines in
    /// `shared`. `lost` is the sum of the minimum losses of the other lines before `line`. Returns
    /// false if the search ends early, because it takes too long or the sum exceeds `max_odds_`.
    /// Visits sets with more shared lines first, because their few alternatives have the largest
    /// odds.
    bool visit(int line, int lost, const PlaceSets& places, LineSet shared) {
        if (line == count_) return add_all(places, shared);
        const int loss = std::max(lines_.ratios.min_loss(line), 0);
        // Sets of shared lines contain only lines with a positive minimum loss. If sets contained
        // other lines, an alternative that shares one of them would be counted twice: in a set with
        // this line, and in the same set without it.
        if (loss > 0 && !visit_shared(line, lost, places, shared)) return false;
        if (lost + loss >= loss_limit_) {
            min_skipped_loss_ = std::min(min_skipped_loss_, lost + loss);
            return true;
        }
        return visit(line + 1, lost + loss, places, shared);
    }

    /// Visits the sets of shared lines that also contain `line`. See `visit`.
    bool visit_shared(int line, int lost, const PlaceSets& places, LineSet shared) {
        const LineSet with_line = shared | LineSet{1} << line;
        if (line == 0 || (shared >> (line - 1) & 1) == 0)
            return visit(line + 1, lost, places, with_line);
        PlaceSets fewer = places;
        equal_places_.keep_equal(static_cast<std::size_t>(line - 1), fewer);
        return equal_places_.count_different(fewer) < 2 || visit(line + 1, lost, fewer, with_line);
    }

    /// Adds the odds of the alternatives that share the lines `shared` and no other lines with a
    /// positive minimum loss. Each alternative is a combination of the given places. Returns false
    /// if the search ends early.
    bool add_all(const PlaceSets& places, LineSet shared) {
        std::size_t combinations = 1;
        for (std::size_t k = 0; k < lists_.size(); ++k) {
            lists_[k].list(places[k]);
            combinations *= lists_[k].count();
        }
        if (shared == 0) return false;
        const Gaps gaps(shared);
        for (std::size_t gap = 0; gap < gaps.count; ++gap)
            combinations /= kSections;
        const auto& [a, b, c, d] = lists_;
        work_ += 10 * a.count() * b.count() + 20 * c.count() * d.count() + 100 * combinations;
        if (work_ > kMaxWork) return false;
        for (std::size_t k = 0; k < lists_.size(); ++k)
            lists_[k].set_offsets(lines_, k, gaps);
        set_pattern(shared);
        add_matches();
        return sum_ <= max_odds_;
    }

    /// Sets the masks `is_compared_` and `is_shared_`. `add` then accepts only alternatives that
    /// share exactly the lines `shared`.
    void set_pattern(LineSet shared) {
        for (int line = 0; line < count_; ++line) {
            const auto n = static_cast<std::size_t>(line);
            is_compared_[n] = lines_.ratios.min_loss(line) > 0 ? 0xFF : 0;
            is_shared_[n] = (shared >> line & 1) != 0 ? 0xFF : 0;
        }
    }

    /// Combines pairs of places in the first two sequences with pairs of places in the last two
    /// sequences. Uses only combinations whose total roll offset changes neither across the first
    /// gap nor across the second gap.
    void add_matches() {
        const auto& [a, b, c, d] = lists_;
        // The captures have new names because clang 14 cannot capture structured bindings.
        const auto visit_pairs = [&, &third = c, &fourth = d](auto use) {
            for (std::size_t n = 0; n < third.count(); ++n) {
                for (std::size_t m = 0; m < fourth.count(); ++m)
                    use(newest_[sum_of_keys(third.key(n), fourth.key(m))],
                        static_cast<std::uint16_t>(kLastPlaces * n + m));
            }
        };
        visit_pairs([&](std::uint16_t& newest, std::uint16_t pair) {
            before_[pair] = newest;
            newest = pair;
        });
        for (std::size_t n = 0; n < a.count(); ++n) {
            for (std::size_t m = 0; m < b.count(); ++m) {
                const unsigned key = opposite(sum_of_keys(a.key(n), b.key(m)));
                for (std::uint16_t pair = newest_[key]; pair != kNone; pair = before_[pair])
                    add({n, m, pair / kLastPlaces, pair % kLastPlaces});
            }
        }
        visit_pairs([](std::uint16_t& newest, std::uint16_t) { newest = kNone; });
    }

    /// Adds the odds of one alternative. `indices` selects its place in each list of places. The
    /// shift is chosen so that the alternative shares the first of the lines passed to
    /// `set_pattern`. Adds nothing if the alternative differs from the reading in fewer than two
    /// sequences, or if the compared lines that it shares are not exactly the lines passed to
    /// `set_pattern`.
    void add(const std::array<std::size_t, 4>& indices) {
        const auto& [a, b, c, d] = indices;
        RollOffsets shifts;
        for (std::size_t line = 0; line < static_cast<std::size_t>(count_); line += sizeof(Bytes)) {
            const Bytes first = modulo_sections(bytes_at(lists_[0].offsets(a), line) +
                                                bytes_at(lists_[1].offsets(b), line));
            const Bytes last = modulo_sections(bytes_at(lists_[2].offsets(c), line) +
                                               bytes_at(lists_[3].offsets(d), line));
            const Bytes shift = modulo_sections(first + last);
            const auto wrong =
                static_cast<Bytes>((static_cast<Bytes>(shift == 0) ^ bytes_at(is_shared_, line)) &
                                   bytes_at(is_compared_, line));
            std::array<std::uint64_t, 2> words;
            std::memcpy(&words, &wrong, sizeof words);
            if ((words[0] | words[1]) != 0) return;
            std::memcpy(shifts.data() + line, &shift, sizeof shift);
        }
        int different = 0;
        for (std::size_t k = 0; k < lists_.size(); ++k)
            different += lists_[k].place(indices[k]) != lines_.ratios.places[k] ? 1 : 0;
        if (different < 2) return;
        int lost = 0;
        for (int line = 0; line < count_; ++line)
            lost += lines_.loss(line, shifts[static_cast<std::size_t>(line)]);
        sum_ += lines_.ratios.odds(lost);
    }

    const RankedLines& lines_;
    int count_;
    int loss_limit_;
    float max_odds_;
    EqualPlaces equal_places_;
    std::array<PlaceList, 4> lists_;
    /// Masks with one byte per line. Each byte is 0 or 255. `is_compared_` selects the lines with a
    /// positive minimum loss, and `is_shared_` selects the lines that must be shared.
    RollOffsets is_compared_{};
    RollOffsets is_shared_{};
    /// Linked lists of pairs of places, one list for each key. `newest_` contains the newest pair
    /// for each key. `before_` contains the next older pair for each pair.
    std::array<std::uint16_t, kKeys> newest_;
    std::array<std::uint16_t, kMaxPairs> before_;
    std::size_t work_ = 0;
    int min_skipped_loss_ = std::numeric_limits<int>::max();
    float sum_ = 0;
};

/// Exponent in the tilted odds (see `log2_of_tilted_odds`). In small views, exponents from 0.8 to 1
/// give the smallest loss limit.
constexpr float kTilt = 0.9F;

/// Minimum loss limit, in bits. A smaller limit would not make the search much faster.
constexpr float kMinBits = 24;

/// Returns log2 of kMargin times the expected total tilted odds of all far alternatives. The tilted
/// odds of an alternative are its odds times 2^(kTilt * min_lost). `min_lost` is the sum, in bits,
/// of the minimum losses of the lines that the alternative does not share.
float log2_of_tilted_odds(const Kernels& kernels, const RankedLines& lines) {
    const LikelihoodRatios& ratios = lines.ratios;
    std::array<OddsByOffset, kMaxLines> storage;
    const auto tilted = std::span(storage).first(static_cast<std::size_t>(lines.count()));
    for (std::size_t line = 0; line < tilted.size(); ++line) {
        const int min_loss = std::max(ratios.min_loss(static_cast<int>(line)), 0);
        const float factor =
            std::exp2(-kTilt / 256 * static_cast<float>(ratios.log2_odds_q8(min_loss)));
        tilted[line] = lines.odds()[line];
        for (float& odds : std::span(tilted[line]).subspan(1))
            odds *= factor;
    }
    float sum = 0;
    for (unsigned different = 0; different < 16; ++different) {
        if (std::popcount(different) < 2) continue;
        sum += kernels.sum_expected_alternatives(ratios.basis, ratios.places, different, tilted,
                                                 ratios.max_shared());
    }
    return std::log2(kMargin * sum);
}

}  // namespace

std::optional<float> sum_of_likely_alternatives(const Kernels& kernels, const RankedLines& lines,
                                                float max_rest, float max_odds) {
    // If the minimum losses of the lines that an alternative does not share add up to n or more
    // bits, its odds are at most 2^(-kTilt * n) times its tilted odds. `needed_bits` is the
    // smallest n for which the tilted odds, multiplied by this factor, are at most `max_rest`.
    // Losses are mostly multiples of the loss of one wrong bit, so the skipped alternatives often
    // lose more than n bits. The result therefore uses their actual minimum loss.
    const float log2_tilted = log2_of_tilted_odds(kernels, lines);
    const float needed_bits = (log2_tilted - std::log2(max_rest)) / kTilt;
    constexpr float kMaxBits = 100;
    if (!(needed_bits < kMaxBits)) return std::nullopt;
    const float bits = std::max(needed_bits, kMinBits);
    const int loss_limit = lines.ratios.loss_for(-static_cast<int>(256 * bits) - 1);
    Finder finder(lines, loss_limit, max_odds);
    const std::optional<float> sum = finder.sum();
    if (!sum) return std::nullopt;
    const int log2_skipped_q8 = lines.ratios.log2_odds_q8(finder.min_skipped_loss());
    return *sum + std::exp2(log2_tilted + kTilt / 256 * static_cast<float>(log2_skipped_q8));
}

}  // namespace dotpose::core
