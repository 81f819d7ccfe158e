// Tuning: empirical constants of grid detection. The constants of the second attempt were
// determined on the hard frames that decode/tuning.hpp names. Comments state the number of frames
// that `dotpose evaluate --preset hard --frames 2000 --seed 404` locates with other values. With
// the values in this file, it locates 1,994.
#pragma once

namespace dotpose::core::tuning {

/// Agreement of dots with a grid that is fitted outwards (lattice/regularity).
namespace regularity {
/// Minimum fraction of dots near an intersection, in 1/20, at which the reach is extended. One dot
/// in twenty may be dirt.
inline constexpr int kSettled_20th = 19;
/// Minimum fraction of dots near an intersection, in 1/10, at which the dots form a grid. Of dots
/// at random places, half are near an intersection.
inline constexpr int kMin_10ths = 7;
}  // namespace regularity

/// Exact grid of the second attempt (lattice/refine_grid).
namespace refine_grid {
/// Number of dots whose median offset gives the origin.
inline constexpr int kMedianSample = 256;
/// Maximum number of rounds at one reach. A better fit assigns more dots to the correct cells.
/// After these rounds, the reach is extended in any case.
inline constexpr int kMaxRounds = 4;
/// Maximum distance of a dot from the nearest of the four places of its cell, in 1/65536 spacing.
/// Dots farther away are false. The value is slightly less than the distance of the places from the
/// intersection. With half or twice the value: 1,994.
inline constexpr int kFar_q16 = 65536 / 8;
/// Number of fits to the nearest places of the dots. The second fit assigns the dots by the better
/// plane of the first fit.
inline constexpr int kPlaceRounds = 2;
}  // namespace refine_grid

/// First grid of the second attempt, from the periodogram (lattice/periodogram_search).
namespace periodogram_search {
/// Half the side, in spacings, of the central square whose dots enter the periodogram: kNear_cells
/// in the first search, kWider_cells in later searches. A smaller square gives a wider peak, which
/// the coarse search grid cannot miss. A larger square gives a more precise maximum. Frames located
/// with kNear_cells = 3: 1,964; with 10: 1,993.
inline constexpr int kNear_cells = 5;
inline constexpr int kWider_cells = 8;
/// Search raster around the first estimate: degrees per step, spacing step as a part (1/n) of the
/// spacing, and number of spacing steps to each side.
inline constexpr int kTurn_deg = 2;
inline constexpr int kStretchPart = 40;
inline constexpr int kStretches = 4;
/// Search raster for each of the two directions, for tilted cameras: up to 9 degrees and 12 % of
/// the spacing to each side. At a tilt of 30 degrees, one spacing is 13 % shorter than the other.
inline constexpr int kTiltTurn_deg = 3;
inline constexpr int kTiltStretchPart = 25;
inline constexpr int kTiltSteps = 3;
/// First steps of the ascent to the maximum, in degrees and as a part (1/n) of the spacing. The
/// last steps are 1/kFinest of the first.
inline constexpr int kFirstTurn_deg = 1;
inline constexpr int kFirstStretchPart = 80;
inline constexpr int kFinest = 8;
}  // namespace periodogram_search

/// Grid of a patch (lattice/outwards).
namespace outwards {
/// Minimum number of dots in a patch. A position needs six lines of six cells, which contain 36
/// dots.
inline constexpr int kMinDots = 40;
/// Minimum and maximum number of dots near the middle that are used to search waves. With fewer
/// dots, chance may cause waves of the same strength. More dots take longer, in each of 12
/// directions, and hardly improve the waves.
inline constexpr int kMinCentralDots = 14;
inline constexpr int kMaxCentralDots = 64;
/// Fractions of the power of a grid without displacements: kClearWaves ends the search, and
/// kFaintWaves is the minimum for the waves to be used.
inline constexpr float kClearWaves = 0.2F;
inline constexpr float kFaintWaves = 0.12F;
/// Range of spacings in the smoothed patch, in px of the patch. In finer grids, dots merge. In
/// coarser grids, a dot has more than one minimum.
inline constexpr float kFinest_px = 5.2F;
inline constexpr float kCoarsest_px = 40;
/// Limits of a plausible fit: factors on the first spacing, because a fit may find half or twice
/// the spacing, and the fold within the reach.
inline constexpr float kMinSpacing = 0.7F;
inline constexpr float kMaxSpacing = 1.4F;
inline constexpr float kMaxFold = 0.7F;
/// Reach of the first rounds, in spacings, and maximum offset of a dot from its intersection in
/// these rounds, in spacings. Displacements count as noise in these rounds.
inline constexpr float kFirstReach = 3;
inline constexpr float kFirstMaxOffset = 0.42F;
/// Range of displacements of a first grid, in spacings: slightly more than the range 0.12 to 0.30
/// of docs/limits.md.
inline constexpr float kMinDisplacement = 0.11F;
inline constexpr float kMaxDisplacement = 0.32F;
/// Radius of the circles around the four places: a fraction of the displacement, but at most
/// kMaxOffset spacings, because larger circles nearly touch.
inline constexpr float kMaxOffsetPart = 0.75F;
inline constexpr float kMaxOffset = 0.18F;
/// Minimum number of dots that determine a plane, and minimum fraction of dots near a place of
/// their cells. A round with fewer dots ends the search without a grid. kMaxRounds is the maximum
/// number of rounds.
inline constexpr float kMinUsed = 12;
inline constexpr float kMinFraction = 0.4F;
inline constexpr int kMaxRounds = 16;
/// Factors on the reach for the next round, by the fraction of dots near a place of their cells. A
/// plane with large errors is thus first improved near the middle.
inline constexpr float kGoodFraction = 0.9F;
inline constexpr float kGoodGrowth = 1.8F;
inline constexpr float kFairFraction = 0.8F;
inline constexpr float kFairGrowth = 1.25F;
inline constexpr float kPoorGrowth = 0.8F;
}  // namespace outwards

}  // namespace dotpose::core::tuning
