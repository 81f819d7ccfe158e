// Likelihood ratios: the losses and odds of alternatives, relative to the reading.
//
// Terms in this folder:
// - Line: a column or a row. A step leads from one line to the next.
// - Reading: the position and the section that were read.
// - Alternative: any other position or section.
// - Loss: the score of the reading minus the score of the alternative, in a line or in all lines. A
//   negative loss is a gain.
// - Odds: the likelihood of the alternative divided by the likelihood of the reading.
// - Place: the index of a position in a secondary sequence. The type `Place` is different: it is a
//   cell in a section.
// - Roll offset: the roll of the alternative minus the roll of the reading in a line, modulo 63.
// - Shift: a number that is added to the roll offsets of all lines. The places of an alternative
//   determine its roll offsets only up to a shift, which depends on its section.
// - Shared line: a line in which the roll offset is 0. Its loss is 0.
// - Single alternative: an alternative whose place differs in one sequence.
// - Far alternative: an alternative whose places differ in two or more sequences.
// - Seam alternative: an alternative with one shift before a border between two lines, and a
//   different shift after the border.
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

/// Maximum number of adjacent lines that two positions can share in the `libdots` code, whose
/// sequence a4 is misprinted. In the other codes, the maximum is `code::kOrder`.
inline constexpr int kMaxShared = 7;

/// log2(62) in units of 2^-8, rounded up. 62 of the 63 possible rolls of a line differ from the
/// roll of the reading.
inline constexpr int kOtherRolls_q8 = 1525;

/// Minimum odds: 2^-64, as log2 in units of 2^-8 and as a plain value. Smaller odds are replaced
/// with 2^-64.
inline constexpr int kNegligible_q8 = -64 * 256;
inline constexpr float kNegligible = 5.5e-20F;

/// Losses and odds of alternatives, line by line.
class LikelihoodRatios {
  public:
    /// Constructs the ratios from scored lines. `odds_per_bit_q8` is the result of
    /// `core::odds_per_bit_q8` and must be positive.
    LikelihoodRatios(CodeVariant code, const Lines& lines_, const AxisReading& reading,
                     int odds_per_bit_q8);
    /// Constructs the ratios from hard bits. Each bit that was read has the weight 127.
    LikelihoodRatios(CodeVariant code, std::span<const ComparedLine> lines_,
                     const AxisReading& reading, int odds_per_bit_q8);

    /// Variant for hard bits in lines whose rolls are known. rolls[i] is the roll of the reading in
    /// line i.
    LikelihoodRatios(CodeVariant code, std::span<const ComparedLine> lines_,
                     const AxisReading& reading, int odds_per_bit_q8,
                     std::span<const std::uint8_t> rolls);

    int count() const { return count_; }
    /// Returns true if the ratios come from hard bits. `lines` is then empty.
    bool is_of_bits() const { return !bits_.empty(); }

    /// Returns the loss of an alternative in a line. `roll_offset` must be in [-62, 62]. Offsets
    /// that are equal modulo 63 have the same loss.
    int loss(int line, int roll_offset) const {
        const int own = rolls_[static_cast<std::size_t>(line)];
        // Uses masks instead of branches, because the branches would often be mispredicted.
        const int moved = own + roll_offset;
        const int up = kSections & -static_cast<int>(moved < 0);
        const int down = kSections & -static_cast<int>(moved >= kSections);
        const int other = moved + up - down;
        if (is_of_bits()) return kScoreOfBit * loss_of_bits(line, other);
        return lines[line][static_cast<std::size_t>(own)] -
               lines[line][static_cast<std::size_t>(other)];
    }
    int own_roll(int line) const { return rolls_[static_cast<std::size_t>(line)]; }
    /// Returns the minimum loss of an alternative that does not share the line. The minimum is
    /// negative if another roll agrees better with the bits of the line.
    int min_loss(int line) const { return min_losses_[static_cast<std::size_t>(line)]; }
    /// Returns the sum of the minimum losses of all lines: the minimum loss of an alternative that
    /// shares no line.
    int min_loss_of_all() const {
        int sum = 0;
        for (int line = 0; line < count_; ++line)
            sum += min_loss(line);
        return sum;
    }
    std::span<const std::int16_t> min_losses(int first, int count) const {
        return std::span(min_losses_)
            .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
    }
    /// Returns the minimum loss of an alternative whose digit for the step from `line` to `line` +
    /// 1 differs from the reading's digit. Such an alternative shares at most one of these two
    /// lines. Negative losses are treated as 0.
    int min_loss_of_step(int line) const {
        return std::max(std::min(min_loss(line), min_loss(line + 1)), 0);
    }
    /// Returns an upper bound on log2(sum / best) for a line, in units of 2^-8. `sum` and `best`
    /// are the sum and the maximum of the odds at all rolls except the roll of the reading. For
    /// hard bits only.
    int log2_of_nearest_q8(int line) const;
    /// Returns the maximum total gain of an alternative: the sum of the largest gains over all
    /// lines where another roll agrees better than the roll of the reading.
    int max_gain() const { return max_gain_; }
    /// Returns the maximum number of adjacent lines that an alternative can share.
    int max_shared() const { return basis[3].has_twins ? kMaxShared : code::kOrder; }
    /// Returns log2 of the odds of an alternative whose total loss is `lost`, in units of 2^-8.
    int log2_odds_q8(int lost) const {
        // `odds_per_bit_q8_` refers to a bit with the full weight 127, which causes a loss of 2 *
        // 127 if it is wrong. The result is therefore -lost * odds_per_bit_q8_ / (2 * 127). The
        // factor 129 / 2^15 replaces the division, and clamping keeps the product within 32 bits.
        constexpr int kMaxLost = 1 << 18;
        return -(((std::min(lost, kMaxLost) * odds_per_bit_q8_) >> 8) * 129 >> 7);
    }
    /// Returns the loss at which the odds are 2^(log2_odds_q8 / 256), rounded up.
    int loss_for(int log2_odds_q8) const { return -log2_odds_q8 * 254 / odds_per_bit_q8_ + 1; }
    /// Returns the odds of an alternative whose total loss is `lost`, clamped to [2^-64, 2^64].
    float odds(int lost) const {
        const int log2_q8 = std::clamp(log2_odds_q8(lost), kNegligible_q8, -kNegligible_q8);
        const int whole = log2_q8 >> 8;
        // Builds the float from its exponent, which begins at bit 23 and has a bias of 127. Uses
        // the builtin, because Emscripten's standard library has no `std::bit_cast`.
        const auto power =
            __builtin_bit_cast(float, static_cast<std::uint32_t>(whole - 16 + 127) << 23);
        // The cast to 32 bits lets compilers vectorise loops over odds.
        return static_cast<float>(static_cast<std::int32_t>(exp2_q16(log2_q8 & 255))) * power;
    }
    /// Returns true if an alternative that loses `lost` in some lines is negligible: its odds are
    /// at most 2^-64, regardless of its gains in the other lines.
    bool is_hopeless(int lost) const { return lost > hopeless_score_; }

    const code::Basis& basis;
    const Lines lines;
    const std::uint32_t position;  ///< position of the first line
    /// Place of `position` in each sequence.
    std::array<std::uint32_t, 4> places;

  private:
    /// Loss caused by one wrong bit with full weight: twice the weight.
    static constexpr int kScoreOfBit = 2 * 127;

    void find_places();
    void follow_rolls(CodeVariant code, const AxisReading& reading);
    void set_min_losses_of_bits();
    void set_min_loss(int line, int min_loss);
    /// Returns the loss in bits: the number of wrong bits at `roll` minus the number of wrong bits
    /// at the roll of the reading.
    int loss_of_bits(int line, int roll) const;
    /// The rolls with the minimum loss in a line, among all rolls except the roll of the reading.
    struct Nearest {
        int lost_bits = 0;      ///< loss of these rolls, in bits
        int log2_count_q8 = 0;  ///< upper bound on log2 of their number, in units of 2^-8
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

/// Roll offset of an alternative in each line, from 0 to 62. If the section of the alternative is
/// unknown, the roll offsets are determined only up to a shift.
using RollOffsets = std::array<std::uint8_t, kMaxLines>;

/// Returns the roll offset, from 0 to 62. `own` is the roll of the reading, and `alternative` is
/// the roll of the alternative. All arithmetic is on bytes so that compilers can vectorise loops
/// over lines.
constexpr std::uint8_t roll_offset(std::uint8_t own, std::uint8_t alternative) {
    return static_cast<std::uint8_t>(alternative - own + (alternative < own ? kSections : 0));
}

/// Sets the roll offsets of the single alternative at `alternative_place` in `sequence`.
inline void set_roll_offsets(const LikelihoodRatios& ratios, std::size_t sequence,
                             std::uint32_t alternative_place, RollOffsets& offsets) {
    static_assert(kMaxLines <= code::kLinesAhead);
    const std::uint8_t* rolls = ratios.basis[sequence].rolls;
    const std::uint8_t* own = rolls + ratios.places[sequence];
    const std::uint8_t* alternative = rolls + alternative_place;
    for (int line = 0; line < ratios.count(); ++line)
        offsets[static_cast<std::size_t>(line)] = roll_offset(own[line], alternative[line]);
}

/// Returns the loss of an alternative at the shift where it shares the line `shared`. If the
/// alternative is negligible (see `LikelihoodRatios::is_hopeless`), stops early and returns the
/// loss so far. Otherwise, returns nullopt if the alternative also shares an earlier line at this
/// shift, because the caller counts the alternative at the earlier line.
std::optional<int> loss_of_offsets(const LikelihoodRatios& ratios, const RollOffsets& offsets,
                                   int shared);

}  // namespace dotpose::core
