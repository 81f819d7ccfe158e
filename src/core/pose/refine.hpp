// Refine: the pose from all dots. Once the position is known, so is where every dot was printed,
// its displacement included; the least-squares map from the dots' centres to these places is the
// pose. differs: the paper stops at eq. 12, whose grid carries the displacements as noise.
#pragma once

#include "core/plane_fit.hpp"
#include "core/pose/observations.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// How the fit went.
struct FitQuality {
    Terms terms = Terms::affine;
    std::int32_t displacement_q16 = 0;  ///< as seen, in spacings
    /// Share, in 1/256, of what the two image axes show of shear and unequal scale; 0: none is
    /// kept.
    int sheared_q8 = 256;
    /// Spread of the dots along u, in 1/256 of that along u and v (sums of squares).
    int spread_u_q8 = 128;
    std::int64_t residual_limit = 0;  ///< squared, 2^-30 spacing^2: dots farther off were left out
};

/// Improves the pose; dots farther off than most are left out, and terms that do not explain more
/// than chance would are not fitted: each costs accuracy. Returns false, with the pose as it was,
/// when the dots do not determine it.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 FitQuality& quality);

}  // namespace dotpose::core
