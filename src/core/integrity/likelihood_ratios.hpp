// Likelihood ratios: the position that was read against the alternatives to it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "code/basis.hpp"
#include "core/decode/lines.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {

/// Most lines in a row that two positions share, in the misprinted code.
inline constexpr int kMostShared = 7;

/// log2 of the number of other rolls, 62, in 2^-8, rounded up.
inline constexpr int kOtherRolls_q8 = 1525;

/// Odds below 2^-64 are not computed further, but counted at this value.
inline constexpr int kNegligible_q8 = -64 * 256;
inline constexpr float kNegligible = 5.5e-20F;

/// The losses and odds of alternatives, line by line.
class LikelihoodRatios {
  public:
    /// Takes the scores of lines. Odds are above 0.
    LikelihoodRatios(Profile profile, const Lines& lines_, const AxisReading& reading,
                     int odds_per_bit_q8);
    /// Takes hard bits, which are either not read or all equally sure, like bits of the weight 127.
    LikelihoodRatios(Profile profile, std::span<const TrackedLine> lines_,
                     const AxisReading& reading, int odds_per_bit_q8);

    /// Ratios of hard bits, as above, for lines whose rolls are known already.
    LikelihoodRatios(Profile profile, std::span<const TrackedLine> lines_,
                     const AxisReading& reading, int odds_per_bit_q8,
                     std::span<const std::uint8_t> rolls);

    int count() const { return count_; }
    /// Returns whether the ratios are of hard bits: there are no scores then, and `lines` is empty.
    bool is_of_bits() const { return !bits_.empty(); }

    /// Returns the score that an alternative loses in a line whose roll it has `shift` further;
    /// |shift| < 63.
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
    /// Returns the least that an alternative loses in a line which it does not share; may be
    /// negative.
    int least_loss(int line) const { return least_losses_[static_cast<std::size_t>(line)]; }
    /// Returns the same for some lines in a row.
    std::span<const std::int16_t> least_losses(int first, int count) const {
        return std::span(least_losses_)
            .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
    }
    /// Returns the least that an alternative loses if its digit differs in the step from a line to
    /// the next, as it does not share one of the two. Not negative.
    int least_loss_of_step(int line) const {
        return std::max(std::min(least_loss(line), least_loss(line + 1)), 0);
    }
    /// Returns log2 of a factor, in 2^-8, by which the odds of the best other roll are at least
    /// those of all other rolls together. For hard bits only.
    int log2_of_nearest_q8(int line) const;
    /// Returns the most that an alternative may regain in lines that other rolls suit better.
    int most_regained() const { return most_regained_; }
    /// Returns the most lines in a row that an alternative shares.
    int most_shared() const { return basis[3].has_twins ? kMostShared : code::kOrder; }
    /// Returns the odds of an alternative against the reading, if it has lost so much score, as
    /// log2 in 2^-8.
    int log2_odds_q8(int lost) const {
        // A lost score is twice the weight. 129 / 2^15 stands for 1 / (2 * 127). More loss than
        // kMost makes no difference.
        constexpr int kMost = 1 << 18;
        return -(((std::min(lost, kMost) * odds_per_bit_q8_) >> 8) * 129 >> 7);
    }
    /// Returns the least loss at which the odds are as low as that.
    int loss_for(int log2_odds_q8) const { return -log2_odds_q8 * 254 / odds_per_bit_q8_ + 1; }
    /// Returns the odds as a number, at least 2^-64 and at most 2^64.
    float odds(int lost) const {
        const int log2_q8 = std::clamp(log2_odds_q8(lost), kNegligible_q8, -kNegligible_q8);
        const int whole = log2_q8 >> 8;
        // The exponent of a float is stored from bit 23 on, with 127 added.
        // std::bit_cast, which the standard library of emscripten lacks.
        const auto power =
            __builtin_bit_cast(float, static_cast<std::uint32_t>(whole - 16 + 127) << 23);
        return static_cast<float>(exp2_q16(log2_q8 - whole * 256)) * power;
    }
    /// Returns whether the odds of an alternative that has lost so much are negligible, whatever it
    /// may regain.
    bool is_hopeless(int lost) const { return lost > hopeless_score_; }

    const code::Basis& basis;
    const Lines lines;
    const std::uint32_t position;  ///< of the first line, as read
    /// The place of `position` in each of the sequences.
    std::array<std::uint32_t, 4> places;

  private:
    /// Score that a full bit loses: its weight, and as much on the other side.
    static constexpr int kScoreOfBit = 2 * 127;

    void find_places();
    void follow_rolls(Profile profile, const AxisReading& reading);
    void set_least_losses_of_bits();
    void set_least_loss(int line, int least_loss);
    /// Returns how many bits more contradict a line at another roll.
    int loss_of_bits(int line, int roll) const;
    /// The other rolls of a line that lose least.
    struct Nearest {
        int lost_bits = 0;      ///< bits that these lose
        int log2_count_q8 = 0;  ///< upper bound of log2 of their number, in 2^-8
    };
    Nearest nearest(int line) const;

    const std::span<const TrackedLine> bits_;
    int count_;
    int odds_per_bit_q8_;
    int most_regained_ = 0;
    int hopeless_score_ = 0;
    std::array<std::uint8_t, kMaxLines> rolls_{};
    std::array<std::int16_t, kMaxLines> least_losses_{};
    std::array<std::int16_t, kMostTracked> log2_of_nearest_q8_;  ///< of hard bits only
};

/// By how much the rolls of an alternative exceed those of the reading, by line, modulo 63; a shift
/// of all lines is left open.
using RollOffsets = std::array<std::uint8_t, kMaxLines>;

/// Returns the roll offset of a line from the rolls of both, below kSections. It is computed in
/// bytes, so that compilers can use vectors.
constexpr std::uint8_t roll_offset(std::uint8_t own, std::uint8_t alternative) {
    return static_cast<std::uint8_t>(alternative - own + (alternative < own ? kSections : 0));
}

/// Sets the roll offsets of an alternative that has another place in one sequence only.
inline void set_roll_offsets(const LikelihoodRatios& ratios, std::size_t sequence,
                             std::uint32_t alternative_place, RollOffsets& offsets) {
    static_assert(kMaxLines <= code::kLinesAhead);
    const std::uint8_t* rolls = ratios.basis[sequence].rolls;
    const std::uint8_t* own = rolls + ratios.places[sequence];
    const std::uint8_t* alternative = rolls + alternative_place;
    for (int line = 0; line < ratios.count(); ++line)
        offsets[static_cast<std::size_t>(line)] = roll_offset(own[line], alternative[line]);
}

/// Returns the loss of an alternative at the shift at which it shares the line `shared`, or what it
/// has lost when that gets hopeless. Returns nothing if it shares an earlier line, too.
std::optional<int> loss_of_offsets(const LikelihoodRatios& ratios, const RollOffsets& offsets,
                                   int shared);

}  // namespace dotpose::core
