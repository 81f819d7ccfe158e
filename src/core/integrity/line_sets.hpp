// Line sets: sets of lines that an alternative shares, the places at which an alternative shares
// given lines, and vectors of roll offsets. likelihood_ratios.hpp defines the terms.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/integrity/loss_tables.hpp"

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
    // The difference wraps around, and is the larger number, if the offset needs no reduction.
    const Bytes reduced = offsets - kSections;
    return reduced < offsets ? reduced : offsets;
}

/// Returns the set of the lines whose roll offset is 0. Bit 0 represents the first of the 16 lines.
inline LineSet shared_lines(const Bytes& offsets) {
    constexpr Bytes kBitOfLine{1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
    const Bytes bits = static_cast<Bytes>(offsets == 0) & kBitOfLine;
    std::array<std::uint64_t, 2> halves;
    std::memcpy(halves.data(), &bits, sizeof bits);
    // The multiplication adds up the bytes, in either byte order.
    constexpr std::uint64_t kOnes = 0x0101010101010101;
    return halves[0] * kOnes >> 56 | halves[1] * kOnes >> 56 << 8;
}

/// Roll offsets of the single alternatives in one sequence, each at the shift at which it shares a
/// given line.
class RelativeOffsets {
  public:
    RelativeOffsets(const LikelihoodRatios& ratios, std::size_t sequence, int shared)
        : rolls_(ratios.basis[sequence].rolls),
          own_(rolls_ + ratios.places[sequence]),
          count_(static_cast<std::size_t>(ratios.count())),
          shared_(shared) {}

    /// Sets `offsets` to the roll offsets of the alternative at `place`.
    void operator()(std::uint32_t place, RollOffsets& offsets) const {
        const std::uint8_t* const alternative = rolls_ + place;
        const std::uint8_t back = roll_offset(alternative[shared_], own_[shared_]);
        // Like the loop in `LossTables::set_offsets`, this loop also accesses elements beyond the
        // last line.
        for (std::size_t line = 0; line < count_; line += sizeof(Bytes)) {
            Bytes from;
            Bytes to;
            std::memcpy(&from, own_ + line, sizeof from);
            std::memcpy(&to, alternative + line, sizeof to);
            const Bytes relative = modulo_sections(modulo_sections(to - from + kSections) + back);
            std::memcpy(offsets.data() + line, &relative, sizeof relative);
        }
    }

  private:
    const std::uint8_t* rolls_;
    const std::uint8_t* own_;  ///< rolls at the place of the reading
    std::size_t count_;
    int shared_;
};

/// Finds the places that have the same digits as the reading at selected steps. Two positions can
/// share two adjacent lines only if, at the step between these lines, they have the same digit in
/// each of the four sequences.
class EqualPlaces {
  public:
    explicit EqualPlaces(const LossTables& lines);

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
