// Likelihood ratios: the losses and odds of alternatives, relative to the reading.
//
// Terms used in this folder: the reading is the position and the section that were read. The odds
// of the reading are 1. An alternative is any other position or section. The roll offset of an
// alternative in a line is its roll minus the roll of the reading, modulo 63. A line is shared if
// the roll offset is 0. The places of an alternative in the four secondary sequences determine its
// roll offsets, except for a shift that is the same in all lines. The shift depends on the section.
// A step leads from one line to the next. A single alternative differs from the reading in the
// place in one secondary sequence, a double alternative in the places in two sequences, and a far
// alternative in the places in two or more sequences. A near alternative shares several adjacent
// lines with the reading. A seam alternative has one shift before a border between two lines, and
// another shift beyond the border.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "code/basis.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/compared_line.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {

/// Maximum number of adjacent lines that two distinct positions share in the code `libdots`, whose
/// a4 is misprinted. In the other codes, the maximum is `code::kOrder`.
inline constexpr int kMaxShared = 7;

/// log2 of 62, the number of rolls other than the roll of the reading, in units of 2^-8, rounded
/// up.
inline constexpr int kOtherRolls_q8 = 1525;

/// Minimum odds of an alternative: 2^-64, as log2 in units of 2^-8 and as a number. Smaller odds
/// count as 2^-64.
inline constexpr int kNegligible_q8 = -64 * 256;
inline constexpr float kNegligible = 5.5e-20F;

/// Losses and odds of alternatives, line by line. The loss of an alternative in a line is the score
/// of the reading minus the score of the alternative. A negative loss is a gain. A line is shared
/// if the reading and the alternative have the same roll in this line. The loss in a shared line is
/// 0.
class LikelihoodRatios {
  public:
    /// Computes the ratios of scored lines. Requires odds_per_bit_q8 > 0.
    LikelihoodRatios(CodeVariant code, const Lines& lines_, const AxisReading& reading,
                     int odds_per_bit_q8);
    /// Computes the ratios of hard bits. Each bit has the weight 127, unless it was not read.
    LikelihoodRatios(CodeVariant code, std::span<const ComparedLine> lines_,
                     const AxisReading& reading, int odds_per_bit_q8);

    /// Computes the ratios of hard bits for lines whose rolls are already known. `rolls` contains
    /// the roll of each line.
    LikelihoodRatios(CodeVariant code, std::span<const ComparedLine> lines_,
                     const AxisReading& reading, int odds_per_bit_q8,
                     std::span<const std::uint8_t> rolls);

    int count() const { return count_; }
    /// Returns true if the ratios were computed from hard bits. Hard bits have no scores, so
    /// `lines` is empty.
    bool is_of_bits() const { return !bits_.empty(); }

    /// Returns the loss of an alternative in a line. The roll of the alternative is the roll of the
    /// reading plus `shift`, modulo 63, with |shift| < 63.
    int loss(int line, int shift) const {
        const int own = rolls_[static_cast<std::size_t>(line)];
        const int moved = own + shift;
        const int other =
            moved < 0 ? moved + kSections : (moved < kSections ? moved : moved - kSections);
        if (is_of_bits()) return kScoreOfBit * loss_of_bits(line, other);
        return lines[line][static_cast<std::size_t>(own)] -
               lines[line][static_cast<std::size_t>(other)];
    }
    int own_roll(int line) const { return rolls_[static_cast<std::size_t>(line)]; }
    /// Returns the minimum loss of an alternative in a line that it does not share. The loss is
    /// negative if another roll fits the line better.
    int min_loss(int line) const { return min_losses_[static_cast<std::size_t>(line)]; }
    /// Returns the minimum losses of `count` adjacent lines, beginning with the line `first`.
    std::span<const std::int16_t> min_losses(int first, int count) const {
        return std::span(min_losses_)
            .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
    }
    /// Returns the minimum loss of an alternative whose digit in the step from `line` to the next
    /// line differs from the digit of the reading. Such an alternative shares at most one of the
    /// two lines. Negative minimum losses of lines count as 0.
    int min_loss_of_step(int line) const {
        return std::max(std::min(min_loss(line), min_loss(line + 1)), 0);
    }
    /// Returns log2 of an upper bound on the ratio of two odds in a line, in units of 2^-8: the
    /// summed odds of all rolls except the roll of the reading, divided by the odds of the best of
    /// these rolls. For hard bits only.
    int log2_of_nearest_q8(int line) const;
    /// Returns the maximum gain of an alternative: the sum of the maximum gains in all lines that
    /// another roll fits better than the roll of the reading.
    int max_gain() const { return max_gain_; }
    /// Returns the maximum number of adjacent lines that an alternative can share with the reading.
    int max_shared() const { return basis[3].has_twins ? kMaxShared : code::kOrder; }
    /// Returns the odds of an alternative with this loss, as log2 in units of 2^-8.
    int log2_odds_q8(int lost) const {
        // A loss is twice the weight of the bits that cause it. 129 / 2^15 is about 1 / (2 * 127).
        // Losses are clamped to kMaxLost, because the product must fit in 32 bits.
        constexpr int kMaxLost = 1 << 18;
        return -(((std::min(lost, kMaxLost) * odds_per_bit_q8_) >> 8) * 129 >> 7);
    }
    /// Returns the loss at which the odds are 2^(log2_odds_q8 / 256), rounded up.
    int loss_for(int log2_odds_q8) const { return -log2_odds_q8 * 254 / odds_per_bit_q8_ + 1; }
    /// Returns the odds of an alternative with this loss as a number, clamped to [2^-64, 2^64].
    float odds(int lost) const {
        const int log2_q8 = std::clamp(log2_odds_q8(lost), kNegligible_q8, -kNegligible_q8);
        const int whole = log2_q8 >> 8;
        // The exponent of a float begins at bit 23 and has a bias of 127. The standard library of
        // Emscripten does not provide `std::bit_cast`.
        const auto power =
            __builtin_bit_cast(float, static_cast<std::uint32_t>(whole - 16 + 127) << 23);
        return static_cast<float>(exp2_q16(log2_q8 - whole * 256)) * power;
    }
    /// Returns true if an alternative whose loss so far is `lost` is negligible, regardless of its
    /// gains in the remaining lines.
    bool is_hopeless(int lost) const { return lost > hopeless_score_; }

    const code::Basis& basis;
    const Lines lines;
    const std::uint32_t position;  ///< position of the first line in the reading
    /// Place of `position` in each sequence.
    std::array<std::uint32_t, 4> places;

  private:
    /// Loss caused by one wrong bit of full weight: twice the weight.
    static constexpr int kScoreOfBit = 2 * 127;

    void find_places();
    void follow_rolls(CodeVariant code, const AxisReading& reading);
    void set_min_losses_of_bits();
    void set_min_loss(int line, int min_loss);
    /// Returns the number of bits of a line that contradict the code at `roll`, minus the number of
    /// bits that contradict the code at the roll of the reading.
    int loss_of_bits(int line, int roll) const;
    /// The nearest rolls of a line: the rolls with the minimum loss among all rolls except the roll
    /// of the reading.
    struct Nearest {
        int lost_bits = 0;      ///< loss of these rolls, in bits
        int log2_count_q8 = 0;  ///< upper bound on log2 of the number of rolls, in units of 2^-8
    };
    Nearest nearest(int line) const;

    const std::span<const ComparedLine> bits_;
    int count_;
    int odds_per_bit_q8_;
    int max_gain_ = 0;
    int hopeless_score_ = 0;
    std::array<std::uint8_t, kMaxLines> rolls_{};
    std::array<std::int16_t, kMaxLines> min_losses_{};
    /// `Nearest::log2_count_q8` of each line. For hard bits only.
    std::array<std::int16_t, kMaxComparedLines> log2_of_nearest_q8_;
};

/// Roll offsets of an alternative, by line: the roll of the alternative minus the roll of the
/// reading, modulo 63. The offsets are determined only up to a shift that is common to all lines.
using RollOffsets = std::array<std::uint8_t, kMaxLines>;

/// Returns the roll offset of a line, from 0 to 62. `own` is the roll of the reading, and
/// `alternative` is the roll of the alternative. The computation in bytes allows compilers to
/// vectorise loops over lines.
constexpr std::uint8_t roll_offset(std::uint8_t own, std::uint8_t alternative) {
    return static_cast<std::uint8_t>(alternative - own + (alternative < own ? kSections : 0));
}

/// Sets the roll offsets of the single alternative with the place `alternative_place` in
/// `sequence`.
inline void set_roll_offsets(const LikelihoodRatios& ratios, std::size_t sequence,
                             std::uint32_t alternative_place, RollOffsets& offsets) {
    static_assert(kMaxLines <= code::kLinesAhead);
    const std::uint8_t* rolls = ratios.basis[sequence].rolls;
    const std::uint8_t* own = rolls + ratios.places[sequence];
    const std::uint8_t* alternative = rolls + alternative_place;
    for (int line = 0; line < ratios.count(); ++line)
        offsets[static_cast<std::size_t>(line)] = roll_offset(own[line], alternative[line]);
}

/// Returns the loss of an alternative at the shift where it shares the line `shared`. Adds the
/// losses of the later lines first, and then the losses of the earlier lines. Stops as soon as the
/// alternative is hopeless, and returns the loss so far. Returns nullopt on reaching an earlier
/// line that is shared at the same shift. The caller adds the odds of the alternative for that line
/// instead.
std::optional<int> loss_of_offsets(const LikelihoodRatios& ratios, const RollOffsets& offsets,
                                   int shared);

}  // namespace dotpose::core
