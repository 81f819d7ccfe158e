// Tuning: empirical constants of grid detection. The constants of the second attempt were
// determined on the hard frames listed in decode/tuning.hpp. Frame counts in comments are the
// numbers of frames that `dotpose evaluate --preset hard --frames 2000 --seed 404` locates with the
// stated value. With the values in this file, the command locates 1,994 of 2,000 frames.
#pragma once

namespace dotpose::core::tuning {

/// Agreement of dots with a grid that is fitted outwards (lattice/regularity).
namespace regularity {
/// Minimum fraction, in 1/20, of the dots within reach that must be near an intersection before the
/// reach is extended. One dot in twenty may be dirt.
inline constexpr int kSettled_20th = 19;
/// Minimum fraction, in 1/10, of the dots that must be near an intersection. With a smaller
/// fraction, the dots do not form a grid. If dots are at random places, half of them are near an
/// intersection.
inline constexpr int kMin_10ths = 7;
}  // namespace regularity

/// Exact grid of the second attempt (lattice/refine_grid).
namespace refine_grid {
/// Maximum number of dots whose median offset corrects the origin.
inline constexpr int kMedianSample = 256;
/// Maximum number of fits at one reach. A better fit assigns more dots to the correct cells. After
/// this number of fits, the reach is always extended.
inline constexpr int kMaxRounds = 4;
/// Maximum distance of a dot from the nearest of the four places of its cell, in 2^-16 spacings.
/// Dots at a larger distance count as false. The value is slightly less than the distance of the
/// places from the intersection. The value is not critical: with half or twice the value, the
/// command also locates 1,994 frames.
inline constexpr int kFar_q16 = 65536 / 8;
/// Number of fits to the nearest places of the dots. The second fit uses the more precise plane of
/// the first fit to assign dots to places.
inline constexpr int kPlaceRounds = 2;
}  // namespace refine_grid

/// First grid of the second attempt, from the periodogram (lattice/periodogram_search).
namespace periodogram_search {
/// Half the side, in spacings, of the central square whose dots contribute to the periodogram:
/// kNear_cells in the searches on a raster, kWider_cells in the ascent to the maximum. A smaller
/// square gives a wider peak, which the coarse raster cannot miss. A larger square gives a more
/// precise maximum. With kNear_cells = 3, the command locates 1,964 frames, and with kNear_cells =
/// 10, 1,993.
inline constexpr int kNear_cells = 5;
inline constexpr int kWider_cells = 8;
/// Raster of the first search: step in direction, in degrees; step in spacing, as a fraction 1/n of
/// the spacing; and number of spacing steps to each side.
inline constexpr int kTurn_deg = 2;
inline constexpr int kStretchPart = 40;
inline constexpr int kStretches = 4;
/// Raster of the separate search for each direction of the grid, for tilted cameras: 3 steps to
/// each side, up to 9 degrees and 12 % of the spacing. At a tilt of 30 degrees, one spacing is 13 %
/// shorter than the other.
inline constexpr int kTiltTurn_deg = 3;
inline constexpr int kTiltStretchPart = 25;
inline constexpr int kTiltSteps = 3;
/// First step sizes of the ascent to the maximum, in degrees and as a fraction 1/n of the spacing.
/// The last step sizes are 1/kFinest of the first step sizes.
inline constexpr int kFirstTurn_deg = 1;
inline constexpr int kFirstStretchPart = 80;
inline constexpr int kFinest = 8;
}  // namespace periodogram_search

/// Grid of a patch (lattice/outwards).
namespace outwards {
/// Minimum number of dots in a patch. A position needs at least six lines of six cells, which
/// contain 36 dots.
inline constexpr int kMinDots = 40;
/// Minimum and maximum number of dots near the middle from which the waves are computed. With fewer
/// dots, waves through dots at random places can be as strong as the waves of a grid. More dots
/// hardly improve the accuracy of the waves, but take longer, because each dot is evaluated in at
/// least 12 directions.
inline constexpr int kMinCentralDots = 14;
inline constexpr int kMaxCentralDots = 64;
/// Limits of the sum of the powers of both waves, divided by the squared number of dots. This ratio
/// is about 2 for a grid without displacements. If it exceeds kClearWaves, no further spacings are
/// tried. Waves with a ratio below kFaintWaves are rejected.
inline constexpr float kClearWaves = 0.2F;
inline constexpr float kFaintWaves = 0.12F;
/// Range of spacings accepted in the smoothed patch, in px of the patch. In finer grids,
/// neighbouring dots merge. In coarser grids, a dot has more than one minimum.
inline constexpr float kFinest_px = 5.2F;
inline constexpr float kCoarsest_px = 40;
/// Limits of a plausible fit: minimum and maximum spacing, relative to the first spacing, and
/// maximum change of the perspective scale within the reach. The limits reject fits that have half
/// or twice the true spacing.
inline constexpr float kMinSpacing = 0.7F;
inline constexpr float kMaxSpacing = 1.4F;
inline constexpr float kMaxFold = 0.7F;
/// Reach of the first rounds, in spacings, and maximum offset of a dot from its intersection in
/// these rounds, in spacings. Displacements count as noise in these rounds.
inline constexpr float kFirstReach = 3;
inline constexpr float kFirstMaxOffset = 0.42F;
/// Range of the displacement in a first grid, in spacings. Slightly wider than the range of 0.12 to
/// 0.30 in docs/limits.md.
inline constexpr float kMinDisplacement = 0.11F;
inline constexpr float kMaxDisplacement = 0.32F;
/// Maximum distance of a dot from the nearest of the four places of its cell: kMaxOffsetPart times
/// the displacement, but at most kMaxOffset spacings, because larger circles around the four places
/// would nearly touch.
inline constexpr float kMaxOffsetPart = 0.75F;
inline constexpr float kMaxOffset = 0.18F;
/// Minimum number of dots that a fit of the plane uses, and minimum fraction of the dots within
/// reach that are near one of the four places of their cell. If a round is below either minimum,
/// the search ends without a grid. kMaxRounds is the maximum number of rounds.
inline constexpr float kMinUsed = 12;
inline constexpr float kMinFraction = 0.4F;
inline constexpr int kMaxRounds = 16;
/// Factors by which the reach is multiplied for the next round. The factor depends on the fraction
/// of the dots within reach that are near a place of their cell: above kGoodFraction, above
/// kFairFraction, or less. If the plane has large errors, the reach shrinks, so the plane is first
/// improved near the middle.
inline constexpr float kGoodFraction = 0.9F;
inline constexpr float kGoodGrowth = 1.8F;
inline constexpr float kFairFraction = 0.8F;
inline constexpr float kFairGrowth = 1.25F;
inline constexpr float kPoorGrowth = 0.8F;
}  // namespace outwards

}  // namespace dotpose::core::tuning
