// Tuning: the numbers of grid detection that were found by trying rather than derived. Those of the
// second attempt were found on the hard frames that decode/tuning.hpp names; where a line compares
// values, it gives the frames located by `dotpose evaluate --preset hard --frames 2000 --seed 404`:
// 1,994 with the values as they are.
#pragma once

namespace dotpose::core::tuning {

/// Numbers for how well dots agree with a grid that is fitted outwards (lattice/regularity).
namespace regularity {
/// Share of dots near an intersection, in 1/20, from which a reach is settled: one in twenty may be
/// dirt.
inline constexpr int kSettled_20th = 19;
/// Share of dots near an intersection, in 1/10, below which there is no grid: dots at random places
/// reach a half.
inline constexpr int kFewest_10ths = 7;
}  // namespace regularity

/// Numbers of the exact grid of the second attempt (lattice/refine_grid).
namespace refine_grid {
/// Reach in cells from which the curvature of a lens is fitted: with fewer dots, their
/// displacements bend the grid by chance. Half or twice as many: 1,994.
inline constexpr int kLensReach_cells = 9;
/// Number of dots whose median gives the origin.
inline constexpr int kMedianSample = 256;
/// Greatest number of rounds at one reach. Each better fit puts more dots into the right cells; a
/// reach that is not settled after these rounds stays as it is.
inline constexpr int kMostRounds = 4;
/// Distance from all four places of its cell beyond which a dot is false, in 1/65536 spacing: a
/// little less than the places lie from the intersection. Half or twice as much: 1,994.
inline constexpr int kFar_q16 = 65536 / 8;
/// Rounds of fits to the dots' nearest places: the second profits from the better plane of the
/// first.
inline constexpr int kPlaceRounds = 2;
}  // namespace refine_grid

/// Numbers of the first grid of the second attempt, from the periodogram
/// (lattice/periodogram_search).
namespace periodogram_search {
/// Dots within this number of spacings along each axis are summed first: the fewer cells, the
/// broader the peak that the raster must hit. Then more are summed, which makes it exact. With 3 at
/// first: 1,964; with 10: 1,993.
inline constexpr int kNear_cells = 5;
inline constexpr int kWider_cells = 8;
/// The raster around the first estimate: degrees per step, steps as parts (1/n) of the spacing, and
/// the number of the latter to either side.
inline constexpr int kTurn_deg = 2;
inline constexpr int kStretchPart = 40;
inline constexpr int kStretches = 4;
/// The raster in which each of the two directions is then searched alone, as a tilted camera sees
/// them: up to 9 degrees and 12 % of the spacing to either side. At a tilt of 30 degrees one
/// spacing is 13 % shorter than the other.
inline constexpr int kTiltTurn_deg = 3;
inline constexpr int kTiltStretchPart = 25;
inline constexpr int kTiltSteps = 3;
/// First steps of the ascent to the maximum, in degrees and as a part (1/n) of the spacing; the
/// last steps are an eighth of these.
inline constexpr int kFirstTurn_deg = 1;
inline constexpr int kFirstStretchPart = 80;
inline constexpr int kFinest = 8;
}  // namespace periodogram_search

/// Numbers of the grid of a patch (lattice/outwards).
namespace outwards {
/// Fewest dots of a patch: six lines of six cells, with 36 dots, are the least that carry a
/// position.
inline constexpr int kFewestDots = 40;
/// Number of dots near the middle in which waves are searched: fewer dots give waves as strong by
/// chance, and more take longer, in each of 12 directions, without making the waves much clearer.
inline constexpr int kFewestCentralDots = 14;
inline constexpr int kMostCentralDots = 64;
/// Shares of the power that a grid without displacements would have: enough to stop the search, and
/// enough to continue with the waves.
inline constexpr float kClearWaves = 0.2F;
inline constexpr float kFaintWaves = 0.12F;
/// Range of spacings in the smoothed patch, in its own px: the dots of finer grids melt together,
/// and those of coarser ones are areas instead of minima.
inline constexpr float kFinest_px = 5.2F;
inline constexpr float kCoarsest_px = 40;
/// Limits of a plausible fit: factors on the first spacing (half or twice of it is wrong), and the
/// fold within reach.
inline constexpr float kLeastSpacing = 0.7F;
inline constexpr float kMostSpacing = 1.4F;
inline constexpr float kMostFold = 0.7F;
/// Reach, in spacings, of the first rounds, in which displacements count as noise, and the greatest
/// distance of a dot from its intersection in these.
inline constexpr float kFirstReach = 3;
inline constexpr float kFirstMostOff = 0.42F;
/// Range of displacements of a first grid, in spacings: those that docs/limits.md allows, 0.12 to
/// 0.30, and a little more.
inline constexpr float kLeastDisplacement = 0.11F;
inline constexpr float kMostDisplacement = 0.32F;
/// Radius of the circles around the four places: a part of the displacement, but at most kMostOff
/// spacings, because wider ones would nearly touch.
inline constexpr float kMostOffPart = 0.75F;
inline constexpr float kMostOff = 0.18F;
/// Fewest dots that determine a plane, and the least share of dots near their places; a round with
/// less ends the search without a grid.
inline constexpr float kFewestUsed = 12;
inline constexpr float kLeastShare = 0.4F;
inline constexpr int kMostRounds = 16;
/// Factors on the reach for the next round, by the share of dots near their places: a plane that is
/// not right yet is improved where it is best.
inline constexpr float kWellShare = 0.9F;
inline constexpr float kWellGrowth = 1.8F;
inline constexpr float kFairShare = 0.8F;
inline constexpr float kFairGrowth = 1.25F;
inline constexpr float kPoorGrowth = 0.8F;
}  // namespace outwards

}  // namespace dotpose::core::tuning
