#include "core/integrity/double_alternatives.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <span>

#include "core/integrity/expected_alternatives.hpp"
#include "core/integrity/expected_double_alternatives.hpp"

namespace dotpose::core {
namespace {

/// Lower limit on the result of `sum_of_double_alternatives`: kNegligible for each pair of places
/// and each shift. Ensures that no fix relies on smaller expected odds. The limit is slightly too
/// large, because 2,217 of the 190,027 pairs contain a place of the reading and are therefore not
/// double alternatives.
constexpr float kFloor = 190'027.0F * kSections * kNegligible;

/// An alternative is counted individually if its odds exceed 2^kLargeOdds_log2, unless the search
/// for such alternatives would take too long (see `kMaxPairs`).
constexpr int kLargeOdds_log2 = -36;

/// Set of anchors (the lines with the most information). Bit n represents anchor n. Anchors are
/// numbered in the order of the lines.
using Anchors = std::uint32_t;

/// A vector with one byte per anchor. The vector fits in one register.
using AnchorBytes [[gnu::vector_size(16)]] = std::uint8_t;
static_assert(sizeof(AnchorBytes) >= kMaxAnchors);

/// Reduces differences of roll offsets modulo 63. The differences are in [-62, 62], and negative
/// differences are represented modulo 256.
AnchorBytes modulo_sections(AnchorBytes offsets) {
    return offsets + (static_cast<AnchorBytes>(offsets >= kSections) & kSections);
}

/// The anchors, divided into `shared - 1` groups. If an alternative shares `shared` anchors, at
/// least two of these anchors are in the same group.
class Groups {
  public:
    Groups(int anchors, int shared) : count_(shared - 1) {
        // Assigns the anchors to the groups in turn, so that the anchors in a group are far apart
        // and few alternatives share two of them.
        for (int n = 0; n < anchors; ++n)
            groups_[static_cast<std::size_t>(n % count_)] |= Anchors{1} << n;
    }

    /// Calls `use(one, other)` for each pair of anchors in the same group. `one` and `other` are
    /// the indices of the anchors.
    template <typename Use>
    void visit_pairs(Use use) const {
        for (std::size_t group = 0; group < static_cast<std::size_t>(count_); ++group) {
            for (Anchors rest = groups_[group]; rest != 0; rest &= rest - 1) {
                const auto one = static_cast<std::size_t>(std::countr_zero(rest));
                for (Anchors others = rest & (rest - 1); others != 0; others &= others - 1)
                    use(one, static_cast<std::size_t>(std::countr_zero(others)));
            }
        }
    }

    /// Returns true if (`one`, `other`) is the first pair that `visit_pairs` visits among the pairs
    /// of anchors in `shared`. An alternative that shares several pairs of anchors is counted only
    /// at the first pair.
    bool is_first_pair(Anchors shared, std::size_t one, std::size_t other) const {
        for (const Anchors group : groups_) {
            const Anchors both = shared & group;
            if ((both & (both - 1)) == 0) continue;
            return static_cast<std::size_t>(std::countr_zero(both)) == one &&
                   static_cast<std::size_t>(std::countr_zero(both & (both - 1))) == other;
        }
        return false;
    }

  private:
    int count_;
    std::array<Anchors, kMaxAnchors - 1> groups_{};
};

/// A vector of bytes, stored in two 64-bit words.
class BytesInWords {
  public:
    explicit BytesInWords(AnchorBytes bytes) {
        std::memcpy(halves_.data(), &bytes, sizeof bytes);
        // The first byte must be the least significant byte of its word.
        if constexpr (std::endian::native == std::endian::big) {
            for (std::uint64_t& half : halves_)
                half = __builtin_bswap64(half);
        }
    }

    /// Returns the sum of all bytes. The sum must be at most 255.
    int sum() const {
        return static_cast<int>((halves_[0] + halves_[1]) * 0x0101010101010101 >> 56);
    }
    /// Returns the set of anchors whose bytes are 1. All other bytes must be 0.
    Anchors anchors() const { return bits_of(halves_[0]) | bits_of(halves_[1]) << 8; }

  private:
    /// Packs the lowest bits of eight bytes into one byte. The multiplication moves each of these
    /// bits to a different bit of the highest byte.
    static Anchors bits_of(std::uint64_t bytes) {
        return static_cast<Anchors>(bytes * 0x0102040810204080 >> 56);
    }

    std::array<std::uint64_t, 2> halves_;
};

/// Roll offsets at the anchors, for every place in the four sequences.
class AnchorOffsets {
  public:
    AnchorOffsets(const RankedLines& lines, int anchors) {
        std::size_t count = 0;
        for (int line = 0; line < lines.count(); ++line) {
            if (lines.rank(static_cast<std::uint32_t>(line)) < anchors)
                lines_[count++] = static_cast<std::size_t>(line);
        }
        RollOffsets by_line;
        for (std::size_t k = 0; k < all_.size(); ++k) {
            for (std::uint32_t place = 0; place < lines.ratios.basis[k].length; ++place) {
                lines.set_offsets(k, place, by_line);
                AnchorBytes& offsets = all_[k][place];
                for (std::size_t n = 0; n < lines_.size(); ++n)
                    offsets[n] = by_line[lines_[n]];
            }
        }
    }
    const AnchorBytes& operator()(std::size_t sequence, std::size_t place) const {
        return all_[sequence][place];
    }

    /// Returns the index of an anchor among the lines in view.
    std::size_t line(std::size_t anchor) const { return lines_[anchor]; }

  private:
    std::array<std::size_t, kMaxAnchors> lines_{};
    std::array<std::array<AnchorBytes, code::kA4Restored.size()>, 4> all_;
};

/// A place in one sequence, prepared for comparison with places in another sequence. offsets[n] is
/// the place's roll offset at a fixed anchor, called `one`, minus its roll offset at anchor n,
/// modulo 63. For a place in the other sequence, `Finder` computes the difference with the opposite
/// sign. If the two differences are equal, an alternative that has both places and shares `one`
/// also shares anchor n.
struct Opposite {
    AnchorBytes offsets;
    std::uint32_t place;
};

/// The places in one sequence except the place of the reading, sorted into buckets by the
/// difference between their offsets at two anchors, modulo 63.
class Buckets {
  public:
    Buckets(const AnchorOffsets& offsets, std::size_t sequence, std::uint32_t length,
            std::uint32_t own, std::size_t one, std::size_t other) {
        std::array<std::uint8_t, code::kA4Restored.size()> less;
        for (std::uint32_t place = 0; place < length; ++place) {
            less[place] = difference(offsets(sequence, place), one, other);
            ++begins_[less[place] + std::size_t{1}];
        }
        --begins_[less[own] + std::size_t{1}];
        for (std::size_t n = 1; n < begins_.size(); ++n)
            begins_[n] = static_cast<std::uint8_t>(begins_[n] + begins_[n - 1]);
        auto next = begins_;
        for (std::uint32_t place = 0; place < length; ++place) {
            if (place == own) continue;
            const AnchorBytes& here = offsets(sequence, place);
            places_[next[less[place]]++] = {modulo_sections(here[one] - here), place};
        }
    }

    /// Returns the offset at the anchor `one` minus the offset at the anchor `other`, modulo 63.
    static std::uint8_t difference(const AnchorBytes& offsets, std::size_t one, std::size_t other) {
        const int less = offsets[one] - offsets[other];
        return static_cast<std::uint8_t>(less < 0 ? less + kSections : less);
    }

    std::span<const Opposite> operator[](std::size_t less) const {
        return std::span(places_).subspan(
            begins_[less], static_cast<std::size_t>(begins_[less + 1] - begins_[less]));
    }

  private:
    std::array<std::uint8_t, kSections + 1> begins_{};
    std::array<Opposite, code::kA4Restored.size()> places_;
};

/// Adds up the odds of the double alternatives that share at least `shared` anchors.
class Finder {
  public:
    Finder(const RankedLines& lines, int anchors, int shared)
        : lines_(lines), offsets_(lines, anchors), shared_(shared), groups_(anchors, shared) {
        const LikelihoodRatios& ratios = lines.ratios;
        const int loss_limit = ratios.loss_for(kSkippedOdds_q8) + ratios.max_gain();
        const int unit = loss_limit / kLimit + 1;
        for (std::size_t n = 0; n < static_cast<std::size_t>(anchors); ++n) {
            const int loss =
                std::max(ratios.min_loss(static_cast<int>(offsets_.line(n))), 0) / unit;
            losses_[n] = static_cast<std::uint8_t>(std::min(loss, kLimit));
            anchors_[n] = 1;
        }
    }

    float sum() const {
        float sum = 0;
        groups_.visit_pairs([&](std::size_t one, std::size_t other) {
            // Each call sorts the places of one sequence into buckets, and combines these places
            // with all places of each sequence in the list. The places of a3 are never sorted into
            // buckets, because visiting all places is fastest for the shortest sequence.
            sum += sum_of_bucketed(0, {2}, one, other) + sum_of_bucketed(1, {0, 2}, one, other) +
                   sum_of_bucketed(3, {0, 1, 2}, one, other);
        });
        return sum;
    }

  private:
    /// Upper bound on the odds of an alternative that is not evaluated line by line, as log2 in
    /// units of 2^-8 and as a plain value.
    static constexpr int kSkippedOdds_q8 = -56 * 256;
    static constexpr float kSkippedOdds = 0x1p-56F;
    static constexpr int kLimit = 20;
    static_assert(kLimit * kMaxAnchors <= 255);

    /// Returns the summed odds of the alternatives that differ in `sequence` and in one of
    /// `others`. Includes an alternative only if (`one`, `other`) is the first pair of anchors that
    /// it shares (see `Groups::is_first_pair`).
    float sum_of_bucketed(std::size_t sequence, std::initializer_list<std::size_t> others,
                          std::size_t one, std::size_t other) const {
        const LikelihoodRatios& ratios = lines_.ratios;
        const Buckets buckets(offsets_, sequence, ratios.basis[sequence].length,
                              ratios.places[sequence], one, other);
        float sum = 0;
        for (const std::size_t k : others) {
            for (std::uint32_t place = 0; place < ratios.basis[k].length; ++place) {
                if (place == ratios.places[k]) continue;
                const AnchorBytes& here = offsets_(k, place);
                const AnchorBytes offsets = modulo_sections(here - here[one]);
                for (const Opposite& b : buckets[Buckets::difference(here, other, one)]) {
                    const auto shared = static_cast<AnchorBytes>(offsets == b.offsets);
                    const BytesInWords marks(shared & anchors_);
                    if (marks.sum() < shared_ ||
                        !groups_.is_first_pair(marks.anchors(), one, other))
                        continue;
                    const int lost = BytesInWords(losses_ & ~shared).sum();
                    sum += lost >= kLimit ? kSkippedOdds : odds(k, place, sequence, b.place, one);
                }
            }
        }
        return sum;
    }

    /// Returns the odds of an alternative with two given places, at the shift where it shares the
    /// given anchor.
    float odds(std::size_t sequence_a, std::uint32_t place_a, std::size_t sequence_b,
               std::uint32_t place_b, std::size_t anchor) const {
        RollOffsets a;
        RollOffsets b;
        lines_.set_offsets(sequence_a, place_a, a);
        lines_.set_offsets(sequence_b, place_b, b);
        // Adding 126, a multiple of 63, keeps the roll offsets positive without changing them
        // modulo 63.
        const std::size_t shared = offsets_.line(anchor);
        const int base = 2 * kSections - a[shared] - b[shared];
        int lost = 0;
        for (int line = 0; line < lines_.count(); ++line) {
            const auto n = static_cast<std::size_t>(line);
            lost += lines_.loss(line, a[n] + b[n] + base);
            if (lines_.ratios.is_hopeless(lost)) return kNegligible;
        }
        return lines_.ratios.odds(lost);
    }

    const RankedLines& lines_;
    AnchorOffsets offsets_;
    int shared_;
    Groups groups_;
    AnchorBytes anchors_{};  ///< 1 for each anchor, 0 in the unused bytes
    /// For each anchor, the minimum loss of an alternative that does not share it, rounded down.
    /// The unit is chosen such that an alternative whose losses add up to kLimit has odds of at
    /// most kSkippedOdds, regardless of its gains in other lines.
    AnchorBytes losses_{};
};

/// Returns, for each n, a lower bound on the loss of an alternative with n unshared anchors. The
/// bound is the sum of the n smallest minimum losses of the anchors, minus the maximum gain.
std::array<int, kMaxAnchors + 1> min_losses_of_unshared(const RankedLines& lines, int anchors) {
    std::array<int, kMaxAnchors> losses{};
    std::size_t count = 0;
    for (int line = 0; line < lines.count(); ++line) {
        if (lines.rank(static_cast<std::uint32_t>(line)) >= anchors) continue;
        const int loss = std::max(lines.ratios.min_loss(line), 0);
        std::size_t n = count++;
        for (; n > 0 && losses[n - 1] > loss; --n)
            losses[n] = losses[n - 1];
        losses[n] = loss;
    }
    std::array<int, kMaxAnchors + 1> sums{-lines.ratios.max_gain()};
    for (std::size_t n = 0; n < count; ++n)
        sums[n + 1] = sums[n] + losses[n];
    return sums;
}

/// Parameters of a search: the number of anchors, and the number of anchors that an alternative
/// must share to be counted individually.
struct Search {
    int anchors;
    int shared;
    /// Returns the number of pairs of anchors that `Finder` visits. The search time is proportional
    /// to this number.
    int pairs() const {
        const int groups = shared - 1;
        const int size = anchors / groups;
        const int larger = anchors % groups;  // number of groups that have one extra anchor
        return groups * size * (size - 1) / 2 + larger * size;
    }
};

/// Maximum number of pairs of anchors in a search for all alternatives with large odds.
constexpr int kMaxPairs = 18;

/// Returns the fastest search that finds all alternatives whose odds may exceed 2^log2_odds. If no
/// search that requires three or more shared anchors finds all of them, returns the search that
/// requires two.
Search fastest_search(const RankedLines& lines, int log2_odds) {
    const int loss_limit = lines.ratios.loss_for(256 * log2_odds);
    Search fastest{std::min(lines.count(), kMaxAnchors), 2};
    for (int anchors = fastest.anchors; anchors >= 6; --anchors) {
        const auto losses = min_losses_of_unshared(lines, anchors);
        for (int shared = anchors; shared > 2; --shared) {
            if (losses[static_cast<std::size_t>(anchors - shared + 1)] < loss_limit) continue;
            const Search search{anchors, shared};
            if (search.pairs() < fastest.pairs()) fastest = search;
            break;
        }
    }
    return fastest;
}

}  // namespace

float sum_of_double_alternatives(const Kernels& kernels, const RankedLines& lines, float expected,
                                 float negligible, float max_odds) {
    const Search search = fastest_search(lines, kLargeOdds_log2);
    if (kMargin * expected <= 4 * negligible && search.pairs() <= kMaxPairs) {
        return kFloor + kMargin * expected + Finder(lines, search.anchors, search.shared).sum();
    }
    const int anchors = std::min(lines.count(), kMaxAnchors);
    const auto by_shared = expected_double_alternatives(kernels, lines, anchors);
    const auto expected_odds = [&](int shared) {
        return kMargin * by_shared[static_cast<std::size_t>(shared)];
    };
    // The search takes longer if it requires fewer shared anchors. With 12 anchors, it visits 6
    // pairs of anchors if it requires seven shared anchors, 18 pairs if it requires four, and 66
    // pairs if it requires two. It requires fewer than four only if the alternatives that share
    // fewer than four anchors have expected odds of more than an eighth of `max_odds`.
    constexpr int kMinForDetail = 4;
    int shared = std::min(kMinFound, anchors);
    while (shared > 2 &&
           expected_odds(shared) > (shared > kMinForDetail ? negligible : max_odds / 8))
        --shared;
    const float rest = expected_odds(shared);
    return kFloor + (rest > max_odds ? rest : rest + Finder(lines, anchors, shared).sum());
}

}  // namespace dotpose::core
