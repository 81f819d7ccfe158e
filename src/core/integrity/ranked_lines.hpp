// Ranked lines: the lines in view by decreasing information, with the roll offsets of all places.
// If losses are added in this order, most alternatives become hopeless after a few lines.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Roll offsets at the ranks 0 to 7, one byte each. Rank 0, the line with the most information, is
/// the lowest byte.
using EightOffsets = std::uint64_t;

/// The byte 1, eight times.
inline constexpr EightOffsets kInEach = 0x0101010101010101;

/// Losses and roll offsets by rank, and odds by line. The line with the most information has rank
/// 0.
class RankedLines {
  public:
    explicit RankedLines(const LikelihoodRatios& ratios);

    /// Roll offsets of a place in a sequence, from 0 to 62.
    struct Offsets {
        EightOffsets first;  ///< roll offsets at the ranks 0 to 7
        RollOffsets all;     ///< roll offsets by rank
    };

    int count() const { return ratios.lines.count(); }
    int line(int rank) const { return lines_[static_cast<std::size_t>(rank)]; }
    int rank(std::uint32_t line) const { return ranks_[line]; }
    /// Returns the odds of an alternative in a line, by roll offset. `line` is an index in the
    /// view, not a rank.
    const std::array<float, kSections>& odds(int line) const {
        return odds_[static_cast<std::size_t>(line)];
    }
    const Offsets& offsets(std::size_t sequence, std::uint32_t place) const {
        return offsets_[kFirsts[sequence] + place];
    }
    /// Returns an alternative's loss in the line with rank `rank`. `further` is the alternative's
    /// roll offset plus a multiple of 63, from 0 to 255.
    int loss(int rank, int further) const {
        return losses_[static_cast<std::size_t>(rank)][static_cast<std::size_t>(further)];
    }
    /// Returns an alternative's loss in the lines with the ranks 0 to 7. Each byte of `further` is
    /// an argument of `loss`. Stops after four lines if their loss is already hopeless.
    int loss_of_first(EightOffsets further) const {
        const int lost = loss_of_four(0, further);
        return ratios.is_hopeless(lost) ? lost : lost + loss_of_four(4, further >> 32);
    }

    const LikelihoodRatios& ratios;

  private:
    static constexpr std::array<std::size_t, 4> kFirsts{
        0, code::kA1.size(), code::kA1.size() + code::kA2.size(),
        code::kA1.size() + code::kA2.size() + code::kA3.size()};
    static constexpr std::size_t kPlaces = kFirsts[3] + code::kA4Restored.size();

    int loss_of_four(int rank, EightOffsets further) const {
        int lost = 0;
        for (int n = 0; n < 4; ++n, further >>= 8)
            lost += loss(rank + n, static_cast<int>(further & 255));
        return lost;
    }
    void rank_lines();
    void set_losses();
    void set_offsets_of_places();

    std::array<std::uint8_t, kMaxLines> lines_{};
    std::array<std::uint8_t, kMaxLines> ranks_{};
    std::array<std::array<float, kSections>, kMaxLines> odds_;
    /// Losses by rank and by `further`. If there are fewer than eight lines, unused ranks below 8
    /// have no loss.
    std::array<std::array<std::int16_t, 256>, kMaxLines> losses_;
    std::array<Offsets, kPlaces> offsets_;
};

}  // namespace dotpose::core
