// Line sets: sets of lines that an alternative shares, the places at which an alternative shares
// given lines, and vectors of roll offsets. likelihood_ratios.hpp defines the terms.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Set of lines. Bit i represents line i.
using LineSet = std::uint64_t;
static_assert(kMaxLines <= 64);

/// For each sequence, a set of places.
using PlaceSets = std::array<PlaceBits, 4>;

/// Roll offsets of 16 lines.
using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
static_assert(kMaxLines % sizeof(Bytes) == 0);

inline Bytes bytes_at(const RollOffsets& offsets, std::size_t line) {
    Bytes bytes;
    std::memcpy(&bytes, offsets.data() + line, sizeof bytes);
    return bytes;
}

/// Reduces roll offsets modulo kSections. The arguments must be less than 2 * kSections.
inline Bytes modulo_sections(Bytes offsets) {
    return offsets - (static_cast<Bytes>(offsets >= kSections) & kSections);
}

/// Sets the roll offsets of the single alternative at `place` in `sequence`. The shift is the one
/// at which the alternative shares the line `shared`.
inline void set_relative_offsets(const LikelihoodRatios& ratios, std::size_t sequence,
                                 std::uint32_t place, int shared, RollOffsets& offsets) {
    const std::uint8_t* const own = ratios.basis[sequence].rolls + ratios.places[sequence];
    const std::uint8_t* const alternative = ratios.basis[sequence].rolls + place;
    const auto back =
        static_cast<std::uint8_t>(kSections - roll_offset(own[shared], alternative[shared]));
    // Like the loop in `RankedLines::set_offsets`, this loop also accesses elements beyond the last
    // line.
    for (std::size_t line = 0; line < static_cast<std::size_t>(ratios.count());
         line += sizeof(Bytes)) {
        Bytes from;
        Bytes to;
        std::memcpy(&from, own + line, sizeof from);
        std::memcpy(&to, alternative + line, sizeof to);
        const Bytes offset = to - from + (static_cast<Bytes>(to < from) & kSections);
        const Bytes relative = modulo_sections(offset + back);
        std::memcpy(offsets.data() + line, &relative, sizeof relative);
    }
}

/// Finds the places that have the same digits as the reading at selected steps. Two positions can
/// share two adjacent lines only if, at the step between these lines, they have the same digit in
/// each of the four sequences.
class EqualPlaces {
  public:
    explicit EqualPlaces(const RankedLines& lines);

    /// All places.
    const PlaceSets& all() const { return all_; }
    /// Removes the places whose digit at the step from line `step` to the next line differs from
    /// the reading's digit.
    void keep_equal(std::size_t step, PlaceSets& places) const;
    /// Returns the number of sequences in which `places` contains a place other than that of the
    /// reading.
    int count_different(const PlaceSets& places) const;

  private:
    PlaceSets all_;
    PlaceSets own_;  ///< the places of the reading
    /// For each step, the places whose digit is equal to the digit of the reading.
    std::array<PlaceSets, kMaxLines> equal_;
};

/// The first two gaps between shared lines. A gap consists of adjacent lines that are not shared.
/// `before` is the first line of the run of shared lines before each gap, and `after` is the first
/// shared line after the gap. If there are fewer than two gaps, the remaining elements are the
/// first shared line of the set.
struct Gaps {
    explicit Gaps(LineSet shared) {
        before = after = {std::countr_zero(shared), std::countr_zero(shared)};
        for (LineSet rest = shared; count < before.size(); ++count) {
            // The addition carries through the first run of shared lines, so `beyond` contains the
            // shared lines after this run.
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

}  // namespace dotpose::core
