// Tuning: empirical constants for grid detection. The constants for the second attempt were
// determined on the hard frames listed in decode/tuning.hpp. Some comments state how many frames
// are located with other values of a constant, as printed by the command
//
//     dotpose evaluate --preset hard --frames 2000 --seed 404
//
// With the values in this file, 1,994 of the 2,000 frames are located.
#pragma once

namespace dotpose::core::tuning {

/// Maximum mean squared distance between the dots of a plain dot grid and their intersections, in
/// spacings^2. The mean of displaced dots is at least 0.12^2, or 1/70 (docs/limits.md).
inline constexpr float kMaxUndisplaced = 1.0F / 256;

/// Growth of a grid fit (lattice/regularity).
namespace regularity {
/// Minimum fraction of dots that are near an intersection, in units of 1/20. If the fraction is
/// reached, the fit is extended to farther dots without another iteration. The value is less than
/// 20, because some detected dots may be dirt.
inline constexpr int kRegular_20th = 19;
/// Minimum fraction of the dots in a grid that are near an intersection, in tenths. If dots are
/// placed randomly, half of them are near an intersection.
inline constexpr int kMin_10ths = 7;
}  // namespace regularity

/// Grid refinement in the second attempt (lattice/refine_grid).
namespace refine_grid {
/// Maximum number of dots used to compute the median offset, which corrects the origin.
inline constexpr int kMedianSample = 256;
/// Maximum number of fits at each reach (see lattice/regularity.hpp). Each fit assigns more dots to
/// the correct cells.
inline constexpr int kMaxRounds = 4;
/// Maximum distance between a dot and the nearest of the four dot positions of its cell, in 2^-16
/// spacings. Dots farther away are treated as false dots. The limit is slightly less than the
/// displacement. With half or twice this value, 1,994 frames are still located.
inline constexpr int kFar_q16 = 65536 / 8;
/// Number of fits to the nearest dot positions. The second fit starts from a more precise plane,
/// and assigns more dots to their correct positions.
inline constexpr int kPlaceRounds = 2;
}  // namespace refine_grid

/// Periodogram search for the first grid in the second attempt (lattice/periodogram_search).
namespace periodogram_search {
/// Half-width of the central square whose dots contribute to the periodogram, in spacings. Raster
/// searches use kNear_cells, because the periodogram of a small square has a peak so wide that a
/// coarse raster cannot miss it. The ascent uses kWider_cells, because the peak of a larger square
/// is more precise. The number of located frames is 1,964 if kNear_cells is 3, and 1,993 if it is
/// 10.
inline constexpr int kNear_cells = 5;
inline constexpr int kWider_cells = 8;
/// Raster of the first search. kTurn_deg is the direction step. kStretchPart is the ratio of the
/// spacing to the spacing step, and kStretches is the number of spacing steps to each side.
inline constexpr int kTurn_deg = 2;
inline constexpr int kStretchPart = 40;
inline constexpr int kStretches = 4;
/// Raster of the separate search for each direction, for tilted cameras. Three steps to each side
/// cover 9 degrees and 12 % of the spacing. This is enough for a tilt of 30 degrees, at which the
/// spacings in the two directions differ by 13 %.
inline constexpr int kTiltTurn_deg = 3;
inline constexpr int kTiltStretchPart = 25;
inline constexpr int kTiltSteps = 3;
/// First steps of the ascent to the maximum. kFirstTurn_deg is the direction step, and
/// kFirstStretchPart is the ratio of the spacing to the spacing step. The last steps are 1/kFinest
/// of the first steps.
inline constexpr int kFirstTurn_deg = 1;
inline constexpr int kFirstStretchPart = 80;
inline constexpr int kFinest = 8;
}  // namespace periodogram_search

/// Grid search in a patch (lattice/outwards, lattice/grid_fit).
namespace outwards {
/// Minimum number of dots in a patch. A position needs at least six lines of six cells, which is 36
/// dots.
inline constexpr int kMinDots = 40;
/// Minimum and maximum number of central dots from which the waves are computed. With fewer dots,
/// even randomly placed dots may produce waves as strong as those of a grid. More dots hardly
/// improve the waves, but take longer, because each dot is evaluated in at least 12 directions.
inline constexpr int kMinCentralDots = 14;
inline constexpr int kMaxCentralDots = 64;
/// Limits on the normalized power: the total power of the two waves divided by the square of the
/// number of dots. It is about 2 for a grid without displacements. If it exceeds kClearWaves, the
/// search does not try further spacings. If it is below kFaintWaves, the waves are rejected.
inline constexpr float kClearWaves = 0.2F;
inline constexpr float kFaintWaves = 0.12F;
/// Range of spacings in the smoothed patch, in patch pixels. In a finer grid, the dots merge. In a
/// coarser grid, one dot may produce several minima.
inline constexpr float kFinest_px = 4.4F;
inline constexpr float kCoarsest_px = 40;
/// Limits for a plausible fit: minimum and maximum spacing relative to the first spacing, and
/// maximum difference between the perspective divisor and 1 within the reach. The limits reject
/// fits with half or twice the true spacing.
inline constexpr float kMinSpacing = 0.7F;
inline constexpr float kMaxSpacing = 1.4F;
inline constexpr float kMaxFold = 0.7F;
/// Parameters of the first rounds, in spacings: the reach, and the maximum offset of a dot from its
/// intersection. These rounds treat displacements as noise.
inline constexpr float kFirstReach = 3;
inline constexpr float kFirstMaxOffset = 0.42F;
/// Limits to which the displacement in a first grid is clamped, in spacings. The range is slightly
/// wider than the supported range of 0.12 to 0.30 (docs/limits.md).
inline constexpr float kMinDisplacement = 0.11F;
inline constexpr float kMaxDisplacement = 0.32F;
/// Maximum distance between a dot and the nearest of the four dot positions of its cell. The limit
/// is kMaxOffsetPart times the displacement, but at most kMaxOffset spacings. kMaxOffset is half
/// the distance between the facing dot positions of two adjacent cells at the largest displacement,
/// kMaxDisplacement.
inline constexpr float kMaxOffsetPart = 0.75F;
inline constexpr float kMaxOffset = 0.18F;
/// A search ends without a grid if a fit uses fewer than kMinUsed dots, or if less than
/// kMinFraction of the dots within `CellPass::reach_px` are near one of the four dot positions of
/// their cell. kMaxRounds is the maximum number of fits.
inline constexpr float kMinUsed = 12;
inline constexpr float kMinFraction = 0.4F;
inline constexpr int kMaxRounds = 16;
/// A fit is good if the fraction exceeds kGoodFraction, and the variance of the distances between
/// the dots and their dot positions, per axis, is less than kGoodVariance, in spacings^2. The
/// variance is less than 0.001 in nearly all nominal frames, and 0.0015 to 0.0025 if the plane is
/// false (`GridFit::grow`).
inline constexpr float kGoodVariance = 0.0012F;
/// Factors by which `CellPass::reach_px` changes after each round. Let f be the fraction of dots
/// near one of the four dot positions of their cell. The factor is kGoodGrowth if f exceeds
/// kGoodFraction, kFairGrowth if f is between kFairFraction and kGoodFraction, and kPoorGrowth
/// otherwise. kPoorGrowth is less than 1, because the plane must first improve near the middle.
inline constexpr float kGoodFraction = 0.9F;
inline constexpr float kGoodGrowth = 1.8F;
inline constexpr float kFairFraction = 0.8F;
inline constexpr float kFairGrowth = 1.25F;
inline constexpr float kPoorGrowth = 0.8F;
}  // namespace outwards

}  // namespace dotpose::core::tuning
