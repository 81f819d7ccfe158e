// Contest: the position that was read against others, its rivals.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "code/basis.hpp"
#include "core/decode/lines.hpp"
#include "core/fixed.hpp"

namespace dotpose::core {

/// Lines in a row that two positions share at most; in the misprinted code.
inline constexpr int kMostShared = 7;

/// Odds below 2^-64 are not followed up, but still counted, at this value.
inline constexpr int kNegligible_q8 = -64 * 256;
inline constexpr float kNegligible = 5.5e-20F;

class Contest {
  public:
    /// Odds are above 0.
    Contest(Profile profile, const Lines& lines_, const AxisReading& reading, int odds_per_bit_q8);

    /// Score that a rival gives up in a line whose roll it puts `shift` further; |shift| < 63.
    int loss(int line, int shift) const {
        const int own = rolls_[static_cast<std::size_t>(line)];
        const int moved = own + shift;
        const int other =
            moved < 0 ? moved + kSections : (moved < kSections ? moved : moved - kSections);
        return lines[line][static_cast<std::size_t>(own)] -
               lines[line][static_cast<std::size_t>(other)];
    }
    int own_roll(int line) const { return rolls_[static_cast<std::size_t>(line)]; }
    /// The least that a rival loses in a line which it does not share; may be negative.
    int least_loss(int line) const { return least_losses_[static_cast<std::size_t>(line)]; }
    /// The most that it may win back in lines that another roll suits better.
    int most_regained() const { return most_regained_; }
    /// Lines in a row that a rival shares at most.
    int most_shared() const { return basis[3].has_twins ? kMostShared : code::kOrder; }
    /// Odds of a rival, against the reading, that has lost so much score: a power of two in 2^-8.
    int log2_odds_q8(int lost) const {
        // Half of the score is weight; 129 / 2^15 is 1 / (2 * 127). More loss makes no difference.
        constexpr int kMost = 1 << 18;
        return -(((std::min(lost, kMost) * odds_per_bit_q8_) >> 8) * 129 >> 7);
    }
    /// The least loss that takes odds that far down.
    int loss_for(int log2_odds_q8) const { return -log2_odds_q8 * 254 / odds_per_bit_q8_ + 1; }
    /// Odds as a number; those for a rival are not told apart from where they are past all doubt.
    float odds(int lost) const {
        const int log2_q8 = std::clamp(log2_odds_q8(lost), kNegligible_q8, -kNegligible_q8);
        const int whole = log2_q8 >> 8;
        // The exponent of a float stands above 23 bits, and 127 too high.
        const auto power = std::bit_cast<float>(static_cast<std::uint32_t>(whole - 16 + 127) << 23);
        return static_cast<float>(exp2_q16(log2_q8 - whole * 256)) * power;
    }
    /// Whether the odds of a rival that has lost so much already are negligible, come what may.
    bool is_hopeless(int lost) const { return lost > hopeless_score_; }

    const code::Basis& basis;
    const Lines lines;
    const std::uint32_t position;  ///< of the first line, as read
    /// The same in each of the sequences.
    std::array<std::uint32_t, 4> places;

  private:
    int odds_per_bit_q8_;
    int most_regained_ = 0;
    int hopeless_score_ = 0;
    std::array<std::uint8_t, kMaxLines> rolls_{};
    std::array<std::int16_t, kMaxLines> least_losses_{};
};

/// By how much the roll of a rival exceeds that of the reading in each line, but for a shift of all
/// lines, modulo 63.
using Growth = std::array<std::uint8_t, kMaxLines>;

/// Of a rival whose place differs in one sequence only.
inline void grow(const Contest& contest, std::size_t sequence, std::uint32_t rival_place,
                 Growth& growth) {
    static_assert(kMaxLines <= code::kLinesAhead);
    const std::uint8_t* rolls = contest.basis[sequence].rolls;
    const std::uint8_t* own = rolls + contest.places[sequence];
    const std::uint8_t* rival = rolls + rival_place;
    for (int line = 0; line < contest.lines.count(); ++line) {
        const int grown = rival[line] - own[line];
        growth[static_cast<std::size_t>(line)] =
            static_cast<std::uint8_t>(grown < 0 ? grown + kSections : grown);
    }
}

/// What a rival that shares the line `shared`, and none before, has lost when that gets hopeless,
/// or in all; nothing if it shares one before.
std::optional<int> loss_of_growth(const Contest& contest, const Growth& growth, int shared);

}  // namespace dotpose::core
