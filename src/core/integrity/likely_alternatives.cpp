#include "core/integrity/likely_alternatives.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "core/integrity/expected_alternatives.hpp"

namespace dotpose::core {
namespace {

/// Set of lines. Bit i is line i.
using LineSet = std::uint64_t;
static_assert(kMaxLines <= 64);

/// For each sequence, a set of places.
using PlaceSets = std::array<PlaceBits, 4>;

/// Roll offsets of 16 lines.
using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
static_assert(kMaxLines % sizeof(Bytes) == 0);

Bytes bytes_at(const RollOffsets& offsets, std::size_t line) {
    Bytes bytes;
    std::memcpy(&bytes, offsets.data() + line, sizeof bytes);
    return bytes;
}

/// Returns offsets modulo 63. The arguments must be less than 126.
Bytes modulo_sections(Bytes offsets) {
    return offsets - (static_cast<Bytes>(offsets >= kSections) & kSections);
}

/// The ends of the first two gaps between shared lines. If there are fewer gaps, both ends of each
/// missing gap are the first shared line.
struct Gaps {
    explicit Gaps(LineSet shared) {
        before = after = {std::countr_zero(shared), std::countr_zero(shared)};
        for (LineSet rest = shared; count < before.size(); ++count) {
            // The addition carries through the first run of shared lines.
            const LineSet beyond = rest & (rest + (rest & -rest));
            if (beyond == 0) break;
            before[count] = std::countr_zero(rest);
            after[count] = std::countr_zero(beyond);
            rest = beyond;
        }
    }
    std::size_t count = 0;
    std::array<int, 2> before;
    std::array<int, 2> after;
};

/// Places in one sequence at which an alternative may share the given lines.
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
    /// Sets the roll offsets and the keys of the listed places.
    void set_offsets(const RankedLines& lines, std::size_t sequence, const Gaps& gaps) {
        const auto line_count = static_cast<std::size_t>(lines.count());
        for (std::size_t n = 0; n < count_; ++n) {
            RollOffsets& offsets = offsets_[n];
            lines.set_offsets(sequence, places_[n], offsets);
            const auto back = static_cast<std::uint8_t>(
                kSections - offsets[static_cast<std::size_t>(gaps.before[0])]);
            for (std::size_t line = 0; line < line_count; line += sizeof(Bytes)) {
                const Bytes relative = modulo_sections(bytes_at(offsets, line) + back);
                std::memcpy(offsets.data() + line, &relative, sizeof relative);
            }
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
    /// Returns the changes of the roll offset across the two gaps, 64 * first + second.
    unsigned key(std::size_t n) const { return keys_[n]; }

  private:
    static constexpr std::size_t kMaxPlaces = code::kA4Restored.size();

    std::size_t count_ = 0;
    std::array<std::uint8_t, kMaxPlaces> places_;
    std::array<std::uint16_t, kMaxPlaces> keys_;
    std::array<RollOffsets, kMaxPlaces> offsets_;
};

constexpr unsigned kKeys = 64 * kSections;

/// Returns the key of two places in different sequences.
unsigned sum_of_keys(unsigned a, unsigned b) {
    unsigned sum = a + b;
    if (a % 64 + b % 64 >= kSections) sum -= kSections;
    return sum >= kKeys ? sum - kKeys : sum;
}
/// Returns the key that cancels `key`.
unsigned opposite(unsigned key) {
    const unsigned first = key / 64;
    const unsigned second = key % 64;
    return 64 * (first == 0 ? 0 : kSections - first) + (second == 0 ? 0 : kSections - second);
}

/// Finds the likely alternatives. Visits all sets of lines whose minimum losses add up to less than
/// the loss limit. For each set, lists the places in each sequence at which an alternative may
/// share all other lines. Two positions share two adjacent lines only if all four digits in the
/// step between these lines are equal.
class Finder {
  public:
    Finder(const RankedLines& lines, int loss_limit, float max_odds)
        : lines_(lines), count_(lines.count()), loss_limit_(loss_limit), max_odds_(max_odds) {
        for (std::size_t k = 0; k < all_.size(); ++k) {
            const code::Secondary& sequence = lines.ratios.basis[k];
            all_[k].fill(0);
            for (std::size_t place = 0; place < sequence.length; ++place)
                all_[k][place / 32] |= std::uint32_t{1} << place % 32;
            const std::uint32_t own = lines.ratios.places[k];
            own_[k].fill(0);
            own_[k][own / 32] = std::uint32_t{1} << own % 32;
            set_equal_places(sequence, k);
        }
        newest_.fill(kNone);
    }

    std::optional<float> sum() {
        const bool is_complete = visit(0, 0, all_, 0);
        return is_complete || sum_ > max_odds_ ? std::optional(sum_) : std::nullopt;
    }

  private:
    /// Maximum time, about in processor instructions.
    static constexpr std::size_t kMaxWork = 2'000'000;
    static constexpr std::size_t kMaxPairs = code::kA3.size() * code::kA4Restored.size();
    static constexpr std::uint16_t kNone = 0xFFFF;
    static_assert(kMaxPairs < kNone);

    void set_equal_places(const code::Secondary& sequence, std::size_t k) {
        std::uint32_t place = lines_.ratios.places[k];
        for (std::size_t step = 0; step + 1 < static_cast<std::size_t>(count_); ++step) {
            const std::uint32_t* equal = sequence.places_of[sequence.digit(place)] + step / 32;
            const std::size_t ahead = step % 32;
            PlaceBits& places = equal_[step][k];
            for (std::size_t word = 0; word < places.size(); ++word)
                places[word] = equal[word] >> ahead | equal[word + 1] << 1 << (31 - ahead);
            if (++place == sequence.length) place = 0;
        }
    }

    /// Extends a set of shared lines, all before `line`, by the lines from `line` on. `lost` is the
    /// loss in the lines before `line`. Returns false if the search ends early.
    bool visit(int line, int lost, const PlaceSets& places, LineSet shared) {
        if (line == count_) return add_all(places, shared);
        const int loss = std::max(lines_.ratios.min_loss(line), 0);
        if (lost + loss < loss_limit_ && !visit(line + 1, lost + loss, places, shared))
            return false;
        // A line without information does not restrict the places.
        if (loss == 0) return true;
        const LineSet with_line = shared | LineSet{1} << line;
        if (line == 0 || (shared >> (line - 1) & 1) == 0)
            return visit(line + 1, lost, places, with_line);
        PlaceSets fewer;
        const PlaceSets& equal = equal_[static_cast<std::size_t>(line - 1)];
        int different = 0;  // number of sequences with other places than the place of the reading
        for (std::size_t k = 0; k < fewer.size(); ++k) {
            std::uint32_t others = 0;
            for (std::size_t word = 0; word < fewer[k].size(); ++word) {
                fewer[k][word] = places[k][word] & equal[k][word];
                others |= fewer[k][word] & ~own_[k][word];
            }
            different += others != 0 ? 1 : 0;
        }
        if (different < 2) return true;
        return visit(line + 1, lost, fewer, with_line);
    }

    /// Adds the odds of all combinations of the given places that share exactly the lines `shared`,
    /// among the lines with information. Returns false if the search ends early.
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

    /// Sets the bytes that `add` compares.
    void set_pattern(LineSet shared) {
        for (int line = 0; line < count_; ++line) {
            const auto n = static_cast<std::size_t>(line);
            is_compared_[n] = lines_.ratios.min_loss(line) > 0 ? 0xFF : 0;
            is_shared_[n] = (shared >> line & 1) != 0 ? 0xFF : 0;
        }
    }

    /// Combines each pair of places in the first two sequences with all pairs of places in the last
    /// two sequences that make the roll offset equal at both ends of each gap.
    void add_matches() {
        const auto& [a, b, c, d] = lists_;
        const auto visit_pairs = [&](auto use) {
            std::uint16_t pair = 0;
            for (std::size_t n = 0; n < c.count(); ++n) {
                for (std::size_t m = 0; m < d.count(); ++m, ++pair)
                    use(newest_[sum_of_keys(c.key(n), d.key(m))], pair);
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
                    add({n, m, pair / d.count(), pair % d.count()});
            }
        }
        visit_pairs([](std::uint16_t& newest, std::uint16_t) { newest = kNone; });
    }

    /// Adds the odds of an alternative at the shift at which it shares the first shared line. Does
    /// not add them if it shares other lines than those of the pattern, or if it differs in fewer
    /// than two sequences. `indices` are indices into the lists of places.
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
    PlaceSets all_;  ///< all places
    PlaceSets own_;  ///< the places of the reading
    /// For each step, the places at which the digit is equal to the digit of the reading.
    std::array<PlaceSets, kMaxLines> equal_;
    std::array<PlaceList, 4> lists_;
    /// 255 for each line with information, and for each line of these that must be shared.
    RollOffsets is_compared_{};
    RollOffsets is_shared_{};
    /// Newest pair of places with each key, and for each pair the previous pair with the same key.
    std::array<std::uint16_t, kKeys> newest_;
    std::array<std::uint16_t, kMaxPairs> before_;
    std::size_t work_ = 0;
    float sum_ = 0;
};

/// Part of the minimum losses by which the odds are raised in the expectation. In small views,
/// values from 0.8 to 1 need the smallest loss limit.
constexpr float kTilt = 0.9F;

/// Loss limit if a smaller limit would suffice, in bits. Up to this limit, the search takes little
/// time.
constexpr float kMinBits = 28;

/// Returns log2 of kMargin times the expected sum of 2^(kTilt * least) times the odds, over all
/// alternatives that differ in at least two sequences. `least` is the sum of the minimum losses in
/// the lines that an alternative does not share, in bits.
float log2_of_tilted_odds(const Kernels& kernels, const RankedLines& lines) {
    const LikelihoodRatios& ratios = lines.ratios;
    std::array<OddsByOffset, kMaxLines> storage;
    const auto tilted = std::span(storage).first(static_cast<std::size_t>(lines.count()));
    for (std::size_t line = 0; line < tilted.size(); ++line) {
        const int least = std::max(ratios.min_loss(static_cast<int>(line)), 0);
        const float factor =
            std::exp2(-kTilt / 256 * static_cast<float>(ratios.log2_odds_q8(least)));
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
    // The odds of an alternative that loses at least n bits are at most 2^(-kTilt * n) times its
    // tilted odds.
    const float log2_tilted = log2_of_tilted_odds(kernels, lines);
    const float needed_bits = (log2_tilted - std::log2(max_rest)) / kTilt;
    constexpr float kMaxBits = 100;
    if (!(needed_bits < kMaxBits)) return std::nullopt;
    const float bits = std::max(needed_bits, kMinBits);
    const int loss_limit = lines.ratios.loss_for(-static_cast<int>(256 * bits) - 1);
    const std::optional<float> sum = Finder(lines, loss_limit, max_odds).sum();
    if (!sum) return std::nullopt;
    return *sum + std::exp2(log2_tilted - kTilt * bits);
}

}  // namespace dotpose::core
