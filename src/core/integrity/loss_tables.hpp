// Loss tables: the losses and odds of alternatives in each line. likelihood_ratios.hpp defines the
// terms.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// The losses and odds of alternatives in each line, indexed by roll offset.
class LossTables {
  public:
    explicit LossTables(const LikelihoodRatios& ratios);

    int count() const { return ratios.lines.count(); }
    /// Returns the summed odds of the alternatives that differ from the reading in this line, over
    /// all rolls except the roll of the reading.
    float odds_of_others(int line) const { return odds_of_others_[static_cast<std::size_t>(line)]; }
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
    std::array<float, kMaxLines> odds_of_others_;
    /// Losses, indexed by line and by the second argument of `loss`.
    std::array<std::array<std::int16_t, 256>, kMaxLines> losses_;
};

/// Returns the number of bits by which the thresholds for negligible odds are lowered if the sum of
/// all odds must be at most `max_odds`. The result is 0 for limits in [2^-32, 2^-30), up to 16 for
/// smaller limits, and down to -20 for larger limits.
inline int extra_bits_for(float max_odds) {
    constexpr int kDefaultLimit_log2 = -30;
    int exponent = 0;
    std::frexp(max_odds, &exponent);  // max_odds < 2^exponent
    const int below = kDefaultLimit_log2 - exponent;
    return below > 0 ? std::min(below - 1, 16) : std::max(below, -20);
}

/// Minimum losses of the lines, rounded down to coarse units so that sums of losses fit in bytes.
/// Each loss is at most `limit`.
struct CoarseLosses {
    /// Chooses the unit such that an alternative loses at least `skipped_bits` bits if its coarse
    /// losses add up to `limit` or more, regardless of its gains in other lines.
    CoarseLosses(const LikelihoodRatios& ratios, int skipped_bits);

    /// Returns the coarse loss at which an alternative loses at least `bits` bits, regardless of
    /// its gains in other lines.
    int loss_for(const LikelihoodRatios& ratios, int bits) const {
        return (ratios.loss_for(-bits * 256) + ratios.max_gain()) / unit + 1;
    }

    int unit;
    int limit;  ///< at most 200, the maximum that `Kernels::list_similar_places` accepts
    std::array<std::uint8_t, kMaxLines> losses;
};

}  // namespace dotpose::core
