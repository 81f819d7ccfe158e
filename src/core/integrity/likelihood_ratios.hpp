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

/// Lines in a row that two positions share at most; in the misprinted code.
inline constexpr int kMostShared = 7;

/// log2 of how many other rolls there are, 62, in 2^-8, rounded up.
inline constexpr int kOtherRolls_q8 = 1525;

/// Odds below 2^-64 are not followed up, but still counted, at this value.
inline constexpr int kNegligible_q8 = -64 * 256;
inline constexpr float kNegligible = 5.5e-20F;

class LikelihoodRatios {
  public:
    /// Odds are above 0.
    LikelihoodRatios(Profile profile, const Lines& lines_, const AxisReading& reading,
                     int odds_per_bit_q8);
    /// The ratios of a tracked frame: its bits are either not read, or all equally sure, as
    /// those with the weight 127 are elsewhere.
    LikelihoodRatios(Profile profile, std::span<const TrackedLine> lines_,
                     const AxisReading& reading, int odds_per_bit_q8);

    int count() const { return count_; }
    /// Whether there are no scores, but only `loss`.
    bool is_of_bits() const { return !bits_.empty(); }

    /// Score that an alternative gives up in a line whose roll it puts `shift` further; |shift|
    /// < 63.
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
    /// The least that an alternative loses in a line which it does not share; may be negative.
    int least_loss(int line) const { return least_losses_[static_cast<std::size_t>(line)]; }
    /// The least that an alternative loses whose digit differs in the step from a line to the next:
    /// one of the two lines is not shared. Not negative.
    int least_loss_of_step(int line) const {
        return std::max(std::min(least_loss(line), least_loss(line + 1)), 0);
    }
    /// log2 of how many rolls lose about as little, in 2^-8, rounded up: the odds of the best, so
    /// often, are at least those of all. Of bits only.
    int log2_of_nearest_q8(int line) const;
    /// The most that it may win back in lines that another roll suits better.
    int most_regained() const { return most_regained_; }
    /// Lines in a row that an alternative shares at most.
    int most_shared() const { return basis[3].has_twins ? kMostShared : code::kOrder; }
    /// Odds of an alternative, against the reading, that has lost so much score: a power of two in
    /// 2^-8.
    int log2_odds_q8(int lost) const {
        // Half of the score is weight; 129 / 2^15 is 1 / (2 * 127). More loss makes no difference.
        constexpr int kMost = 1 << 18;
        return -(((std::min(lost, kMost) * odds_per_bit_q8_) >> 8) * 129 >> 7);
    }
    /// The least loss that takes odds that far down.
    int loss_for(int log2_odds_q8) const { return -log2_odds_q8 * 254 / odds_per_bit_q8_ + 1; }
    /// Odds as a number; those for an alternative are not told apart from where they are past all
    /// doubt.
    float odds(int lost) const {
        const int log2_q8 = std::clamp(log2_odds_q8(lost), kNegligible_q8, -kNegligible_q8);
        const int whole = log2_q8 >> 8;
        // The exponent of a float stands above 23 bits, and 127 too high.
        const auto power = std::bit_cast<float>(static_cast<std::uint32_t>(whole - 16 + 127) << 23);
        return static_cast<float>(exp2_q16(log2_q8 - whole * 256)) * power;
    }
    /// Whether the odds of an alternative that has lost so much already are negligible, come what
    /// may.
    bool is_hopeless(int lost) const { return lost > hopeless_score_; }

    const code::Basis& basis;
    const Lines lines;
    const std::uint32_t position;  ///< of the first line, as read
    /// The same in each of the sequences.
    std::array<std::uint32_t, 4> places;

  private:
    /// Score of a full bit that is lost: what it was worth, and as much against it.
    static constexpr int kScoreOfBit = 2 * 127;

    void follow_rolls(Profile profile, const AxisReading& reading);
    void set_least_loss(int line, int least_loss);
    /// Bits that who puts a line at another roll contradicts more.
    int loss_of_bits(int line, int roll) const;
    struct Nearest {
        int lost_bits = 0;      ///< by the other rolls that lose least
        int log2_count_q8 = 0;  ///< how many these are, at most
    };
    Nearest nearest(int line) const;

    const std::span<const TrackedLine> bits_;
    int count_;
    int odds_per_bit_q8_;
    int most_regained_ = 0;
    int hopeless_score_ = 0;
    std::array<std::uint8_t, kMaxLines> rolls_{};
    std::array<std::int16_t, kMaxLines> least_losses_{};
    std::array<std::int16_t, kMostTracked> log2_of_nearest_q8_;  ///< how many lose least; of bits
};

/// By how much the roll of an alternative exceeds that of the reading in each line, but for a shift
/// of all lines, modulo 63.
using RollOffsets = std::array<std::uint8_t, kMaxLines>;

/// Of a line that has the roll `alternative` rather than `own`, both below kSections. In bytes, so
/// that it is done in vectors where there are any.
constexpr std::uint8_t roll_offset(std::uint8_t own, std::uint8_t alternative) {
    return static_cast<std::uint8_t>(alternative - own + (alternative < own ? kSections : 0));
}

/// Of an alternative whose place differs in one sequence only.
inline void set_roll_offsets(const LikelihoodRatios& ratios, std::size_t sequence,
                             std::uint32_t alternative_place, RollOffsets& offsets) {
    static_assert(kMaxLines <= code::kLinesAhead);
    const std::uint8_t* rolls = ratios.basis[sequence].rolls;
    const std::uint8_t* own = rolls + ratios.places[sequence];
    const std::uint8_t* alternative = rolls + alternative_place;
    for (int line = 0; line < ratios.count(); ++line)
        offsets[static_cast<std::size_t>(line)] = roll_offset(own[line], alternative[line]);
}

/// What an alternative that shares the line `shared`, and none before, has lost when that gets
/// hopeless, or in all; nothing if it shares one before.
std::optional<int> loss_of_offsets(const LikelihoodRatios& ratios, const RollOffsets& offsets,
                                   int shared);

}  // namespace dotpose::core
