#include "core/integrity/double_alternatives.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <span>

#include "core/integrity/expected_double_alternatives.hpp"

namespace dotpose::core {
namespace {

/// Minimum result: kNegligible for each pair of places, at each shift. No fix may rely on smaller
/// expected odds. There are 190,027 pairs, including 2,217 pairs with one of the reading's places.
constexpr float kFloor = 190'027.0F * kSections * kNegligible;

/// Safety factor for expected odds. Expected odds are means over all positions, and the odds at a
/// given position can be larger. On 5,630 axes of hard frames, the odds were at most 21 times the
/// mean.
constexpr float kMargin = 32;

/// Set of anchors, one bit per rank. Anchors are the lines with the most information.
using Anchors = std::uint32_t;

/// The anchors in `shared - 1` groups. An alternative that shares `shared` anchors therefore shares
/// at least two anchors in the same group.
class Groups {
  public:
    Groups(const RankedLines& lines, int anchors, int shared) : count_(shared - 1) {
        // Assigns the anchors to the groups in turn. Anchors in a group are therefore far apart,
        // and few alternatives share two of them.
        int n = 0;
        for (int line = 0; line < lines.count(); ++line) {
            const int rank = lines.rank(static_cast<std::uint32_t>(line));
            if (rank < anchors) groups_[static_cast<std::size_t>(n++ % count_)] |= 1U << rank;
        }
    }

    /// Calls `use(one, other)` for each pair of anchors in the same group. `one` and `other` are
    /// ranks.
    template <typename Use>
    void visit_pairs(Use use) const {
        for (std::size_t group = 0; group < static_cast<std::size_t>(count_); ++group) {
            for (Anchors rest = groups_[group]; rest != 0; rest &= rest - 1) {
                const int one = std::countr_zero(rest);
                for (Anchors others = rest & (rest - 1); others != 0; others &= others - 1)
                    use(one, std::countr_zero(others));
            }
        }
    }

    /// Returns true if (`one`, `other`) is the first pair in `visit_pairs` whose anchors are both
    /// in `shared`. An alternative is added only at its first pair.
    bool is_first_pair(Anchors shared, int one, int other) const {
        for (const Anchors group : groups_) {
            const Anchors both = shared & group;
            if ((both & (both - 1)) == 0) continue;
            return std::countr_zero(both) == one && std::countr_zero(both & (both - 1)) == other;
        }
        return false;
    }

  private:
    int count_;
    std::array<Anchors, kMinFound - 1> groups_{};
};

/// One byte per line, for ranks 0 to 15. Includes all anchors and fits in one register.
using AnchorBytes [[gnu::vector_size(16)]] = std::uint8_t;
static_assert(sizeof(AnchorBytes) >= kMaxAnchors && sizeof(AnchorBytes) <= kMaxLines);

int at(const RankedLines::Offsets& offsets, int rank) {
    return offsets.all[static_cast<std::size_t>(rank)];
}

/// Reduces differences in [-62, 62] modulo 63. Negative differences are stored modulo 256.
AnchorBytes modulo_sections(AnchorBytes offsets) {
    return offsets + (static_cast<AnchorBytes>(offsets >= kSections) & kSections);
}

AnchorBytes anchors_of(const RankedLines::Offsets& offsets) {
    AnchorBytes bytes;
    std::memcpy(&bytes, offsets.all.data(), sizeof bytes);
    return bytes;
}

/// Returns a place's offsets at all anchors minus the offset at the anchor `one`, modulo 63.
AnchorBytes since(int one, const RankedLines::Offsets& offsets) {
    return modulo_sections(anchors_of(offsets) - offsets.all[static_cast<std::size_t>(one)]);
}

/// Returns the negative of `since`, modulo 63. If two places share the anchor `one`, they also
/// share each anchor where `since` of one place equals `opposite` of the other.
AnchorBytes opposite(int one, const RankedLines::Offsets& offsets) {
    return modulo_sections(offsets.all[static_cast<std::size_t>(one)] - anchors_of(offsets));
}

/// Set of anchors, one byte per rank: 1 for an anchor in the set, otherwise 0.
class Marks {
  public:
    explicit Marks(AnchorBytes marks) {
        std::memcpy(halves_.data(), &marks, sizeof marks);
        // Moves the first byte to the lowest byte of the word.
        if constexpr (std::endian::native == std::endian::big) {
            for (std::uint64_t& half : halves_)
                half = __builtin_bswap64(half);
        }
    }

    int count() const { return static_cast<int>((halves_[0] + halves_[1]) * kInEach >> 56); }
    Anchors anchors() const { return bits_of(halves_[0]) | bits_of(halves_[1]) << 8; }

  private:
    /// Packs the lowest bits of eight bytes into one byte. The multiplication moves each bit to a
    /// different bit in the highest byte.
    static Anchors bits_of(std::uint64_t bytes) {
        return static_cast<Anchors>(bytes * 0x0102040810204080 >> 56);
    }

    std::array<std::uint64_t, 2> halves_;
};

/// A place in a sequence, with its `opposite` offsets. `Finder` compares these offsets with `since`
/// of a place in another sequence.
struct Opposite {
    AnchorBytes offsets;
    const RankedLines::Offsets* place;
};

/// The places in a sequence, in buckets by the difference between a place's offsets at two anchors,
/// modulo 63. Excludes the reading's place.
class Buckets {
  public:
    Buckets(const RankedLines& lines, std::size_t sequence, int one, int other) {
        const std::uint32_t length = lines.ratios.basis[sequence].length;
        const std::uint32_t own = lines.ratios.places[sequence];
        const auto less_at = [&](std::uint32_t place) {
            return offset_less(lines.offsets(sequence, place), one, other);
        };
        for (std::uint32_t place = 0; place < length; ++place)
            ++begins_[less_at(place) + 1];
        --begins_[less_at(own) + 1];
        for (std::size_t n = 1; n < begins_.size(); ++n)
            begins_[n] = static_cast<std::uint8_t>(begins_[n] + begins_[n - 1]);
        auto next = begins_;
        for (std::uint32_t place = 0; place < length; ++place) {
            if (place == own) continue;
            const RankedLines::Offsets& offsets = lines.offsets(sequence, place);
            places_[next[less_at(place)]++] = {opposite(one, offsets), &offsets};
        }
    }

    /// Returns the offset at the anchor `one` minus the offset at the anchor `other`, modulo 63.
    static std::size_t offset_less(const RankedLines::Offsets& offsets, int one, int other) {
        const int less = at(offsets, one) - at(offsets, other);
        return static_cast<std::size_t>(less < 0 ? less + kSections : less);
    }

    std::span<const Opposite> operator[](std::size_t less) const {
        return std::span(places_).subspan(
            begins_[less], static_cast<std::size_t>(begins_[less + 1] - begins_[less]));
    }

  private:
    std::array<std::uint8_t, kSections + 1> begins_{};
    std::array<Opposite, code::kA4Restored.size()> places_;
};

/// Adds up the odds of the double alternatives with at least `shared` shared anchors.
class Finder {
  public:
    Finder(const RankedLines& lines, int anchors, int shared)
        : lines_(lines), shared_(shared), groups_(lines, anchors, shared) {
        for (int rank = 0; rank < anchors; ++rank)
            anchors_[rank] = 1;
    }

    float sum() const {
        float sum = 0;
        groups_.visit_pairs([&](int one, int other) {
            // Sorts one sequence in each pair into buckets. This sequence is never a3, the shortest
            // one.
            sum += sum_of_bucketed(0, {2}, one, other) + sum_of_bucketed(1, {0, 2}, one, other) +
                   sum_of_bucketed(3, {0, 1, 2}, one, other);
        });
        return sum;
    }

  private:
    /// Returns the summed odds of alternatives that differ in `sequence` and in a sequence from
    /// `others`. Includes only alternatives whose first shared pair is (`one`, `other`).
    float sum_of_bucketed(std::size_t sequence, std::initializer_list<std::size_t> others, int one,
                          int other) const {
        const Buckets buckets(lines_, sequence, one, other);
        float sum = 0;
        for (const std::size_t k : others) {
            for (std::uint32_t place = 0; place < lines_.ratios.basis[k].length; ++place) {
                if (place == lines_.ratios.places[k]) continue;
                const RankedLines::Offsets& a = lines_.offsets(k, place);
                const AnchorBytes offsets = since(one, a);
                for (const Opposite& b : buckets[Buckets::offset_less(a, other, one)]) {
                    const Marks marks(static_cast<AnchorBytes>(offsets == b.offsets) & anchors_);
                    if (marks.count() >= shared_ &&
                        groups_.is_first_pair(marks.anchors(), one, other)) {
                        sum += odds(a, *b.place, at(a, one) + at(*b.place, one));
                    }
                }
            }
        }
        return sum;
    }

    /// Returns the odds of a pair of places at the shift where the pair shares a given line.
    /// `shared` is the sum of the two places' offsets in this line.
    float odds(const RankedLines::Offsets& a, const RankedLines::Offsets& b, int shared) const {
        // Adding 126, a multiple of 63, keeps the loss index positive.
        const int base = 2 * kSections - shared;
        int lost = 0;
        for (int rank = 0; rank < lines_.count(); ++rank) {
            lost += lines_.loss(rank, at(a, rank) + at(b, rank) + base);
            if (lines_.ratios.is_hopeless(lost)) return kNegligible;
        }
        return lines_.ratios.odds(lost);
    }

    const RankedLines& lines_;
    int shared_;
    Groups groups_;
    AnchorBytes anchors_{};  ///< 1 for anchors, 0 for other lines
};

}  // namespace

float sum_of_double_alternatives(const RankedLines& lines, float negligible, float max_odds) {
    const int anchors = std::min(lines.count(), kMaxAnchors);
    const auto expected = expected_double_alternatives(lines, anchors);
    const auto expected_odds = [&](int shared) {
        return kMargin * expected[static_cast<std::size_t>(shared)];
    };
    // Requiring fewer anchors means visiting more pairs: 6 of 66 for seven anchors, 18 for four,
    // and all 66 for two. Fewer than four anchors are worth the time only to avoid a refusal.
    constexpr int kMinForDetail = 4;
    int shared = std::min(kMinFound, anchors);
    while (shared > 2 &&
           expected_odds(shared) > (shared > kMinForDetail ? negligible : max_odds / 8))
        --shared;
    const float rest = expected_odds(shared);
    return kFloor + (rest > max_odds ? rest : rest + Finder(lines, anchors, shared).sum());
}

}  // namespace dotpose::core
