// Contest: the position that was read against others, its rivals.
#pragma once

#include <cmath>

#include "code/basis.hpp"
#include "core/decode/lines.hpp"
#include "core/fixed.hpp"

namespace dotpose::core {

/// Odds below 2^-64 are not followed up, but still counted, at this value.
inline constexpr int kNegligible_q8 = -64 * 256;
inline constexpr float kNegligible = 5.5e-20F;

class Contest {
  public:
    Contest(Profile profile, const Lines& lines_, const AxisReading& reading, int odds_per_bit_q8);

    /// Score that a rival gives up in a line whose roll it puts `shift` further; |shift| < 63.
    int loss(int line, int shift) const {
        const int own = rolls_[static_cast<std::size_t>(line)];
        const int other = (own + shift + kSections) % kSections;
        return lines[line][static_cast<std::size_t>(own)] -
               lines[line][static_cast<std::size_t>(other)];
    }
    /// Odds of a rival, against the reading, that has lost so much score.
    float odds(int lost) const {
        const int log2_q8 = std::max(log2_odds_q8(lost), kNegligible_q8);
        const int whole = log2_q8 >> 8;
        return std::ldexp(static_cast<float>(exp2_q16(log2_q8 - whole * 256)), whole - 16);
    }
    /// Whether the odds of a rival that has lost so much already are negligible, come what may.
    bool is_hopeless(int lost) const { return lost > hopeless_score_; }

    const code::Basis& basis;
    const Lines& lines;
    const std::uint32_t position;  ///< of the first line, as read

  private:
    int log2_odds_q8(int lost) const {
        return static_cast<int>(-std::int64_t{lost} * odds_per_bit_q8_ / (2 * 127));
    }

    int odds_per_bit_q8_;
    int hopeless_score_ = 0;
    std::array<std::uint8_t, kMaxLines> rolls_{};
};

}  // namespace dotpose::core
