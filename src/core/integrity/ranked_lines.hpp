// Ranked lines: ranks the lines in view by decreasing information, and tabulates the losses and
// odds of alternatives in each line. A line contains more information if alternatives that do not
// share the line have smaller odds. likelihood_ratios.hpp defines the terms.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// The losses, the odds and the rank of each line. The line with the most information has rank 0.
class RankedLines {
  public:
    explicit RankedLines(const LikelihoodRatios& ratios);

    int count() const { return ratios.lines.count(); }
    int rank(std::uint32_t line) const { return ranks_[line]; }
    /// Returns one table per line: the odds of an alternative in this line, indexed by roll offset.
    /// The odds are at least kNegligible. The last element of each table is padding and is 0.
    std::span<const OddsByOffset> odds() const {
        return std::span(odds_).first(static_cast<std::size_t>(count()));
    }
    /// Sets the roll offsets of the single alternative at `place` in `sequence`. Vectorised variant
    /// of `set_roll_offsets`.
    void set_offsets(std::size_t sequence, std::uint32_t place, RollOffsets& offsets) const;
    /// Returns the loss of an alternative in a line. `further` is the roll offset of the
    /// alternative plus a multiple of 63, and must be in [0, 255].
    int loss(int line, int further) const {
        return losses_[static_cast<std::size_t>(line)][static_cast<std::size_t>(further)];
    }

    /// Returns the losses in a line, indexed by `further` (see `loss`).
    const std::int16_t* losses(std::size_t line) const { return losses_[line].data(); }

    const LikelihoodRatios& ratios;

  private:
    void rank_lines();

    std::array<std::uint8_t, kMaxLines> ranks_{};
    std::array<OddsByOffset, kMaxLines> odds_;
    /// Losses, indexed by line and by the second argument of `loss`.
    std::array<std::array<std::int16_t, 256>, kMaxLines> losses_;
};

/// Minimum losses of the lines, rounded down to coarse units so that sums of losses fit in bytes.
/// Each loss is at most `limit`.
struct CoarseLosses {
    /// Chooses the unit such that an alternative loses at least `skipped_bits` bits if its coarse
    /// losses add up to `limit` or more, regardless of its gains in other lines.
    CoarseLosses(const LikelihoodRatios& ratios, int skipped_bits);

    int limit;  ///< at most 200, the maximum that `Kernels::list_similar_places` accepts
    std::array<std::uint8_t, kMaxLines> losses;
};

}  // namespace dotpose::core
