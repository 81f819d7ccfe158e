// Rolls: computes the rolls of columns and rows. The roll of a line is the index in the main
// sequence at which its bits begin. For adjacent lines, `follow_rolls` is faster than calling
// `roll_from` for each line.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "code/basis.hpp"
#include "code/tables.hpp"
#include "dotpose/code.hpp"

namespace dotpose::code {

/// Returns the roll of a column or row, in [0, 62]. `position` and `section` identify the line.
/// `cross` is the position, on the other axis, of the line's first bit.
int roll_from(CodeVariant code, std::uint32_t position, int section, std::uint32_t cross);

/// Returns the roll of a position in the code `other`, minus the roll of the same position in the
/// code `read`, modulo 63. `place` is the place of the position in a4, the only sequence that
/// differs between codes.
int roll_further(CodeVariant read, CodeVariant other, std::uint32_t position, std::uint32_t place);

/// Sets rolls[i] to the roll of line `position` + i. `first_roll` is the roll of line `position`.
/// The range may extend beyond the last position, because the roll differences are periodic.
void follow_rolls(CodeVariant code, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls);

/// Sets rolls[i] to the roll of line `position` + i in a section. `cross` is the position, on the
/// other axis, of the first bit of each line.
void follow_rolls(CodeVariant code, std::uint32_t position, int section, std::uint32_t cross,
                  std::span<std::uint8_t> rolls);

/// Computes the rolls of consecutive lines in section 0 on demand. If only a few rolls are needed,
/// this is faster than `follow_rolls`, which computes all of them.
class RollsAhead {
  public:
    RollsAhead(CodeVariant code, std::uint32_t position);

    /// Advances the position by 63 lines. This is faster than constructing a new object.
    void advance();
    /// Returns the roll of line `position` + i, plus `added`, modulo 63. Requires i < kLinesAhead
    /// and added < 63.
    std::uint32_t at(std::uint32_t i, std::uint32_t added) const {
        return short_modulo_sections(sum_ + added + here_[0][i] + here_[1][i] + here_[2][i] +
                                     here_[3][i] + kMinDelta * i);
    }

  private:
    /// Sets the place in sequence k, and adds the contribution of the preceding whole periods to
    /// `sum_`.
    void add(const Secondary& sequence, std::size_t k, std::uint32_t place) {
        here_[k] = sequence.rolls + place;
        sum_ += (lines_ - place) * sequence.period_roll;
    }

    const Basis& sequences_;
    std::array<const std::uint8_t*, 4> here_;
    std::uint32_t lines_;  ///< congruent to the position modulo 63, and larger than any place
    std::uint32_t sum_;
};

}  // namespace dotpose::code
