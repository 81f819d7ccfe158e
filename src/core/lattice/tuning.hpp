// Tuning: the numbers of finding the grid that were found by trying rather than derived. Those of
// the second attempt were found on the hard frames that decode/tuning.hpp names; where a line says
// what other values do, these are frames located by
// `dotpose evaluate --preset hard --frames 2000 --seed 404`: 1,994 with the values as they are.
#pragma once

namespace dotpose::core::tuning {

/// How well dots sit on a grid that is fitted outwards (lattice/regularity).
namespace regularity {
/// Share of dots near an intersection, in 1/20, from which on a reach is settled: one in twenty may
/// be dirt.
inline constexpr int kSettled_20th = 19;
/// The same in 1/10, below which there is no grid: dots anywhere in their cells reach a half.
inline constexpr int kFewest_10ths = 7;
}  // namespace regularity

/// The exact grid of the second attempt (lattice/refine_grid).
namespace refine_grid {
/// Reach from which dots can tell the curvature of a lens from their displacements, in cells: from
/// fewer, chance bends the grid. Half or twice as many: 1,994.
inline constexpr int kLensReach_cells = 9;
/// Dots whose median tells where the origin lies.
inline constexpr int kMedianSample = 256;
/// Rounds of one reach, at most. Dots that a better fit puts into other cells make the next one
/// better still; a reach that is not settled by then is left as it is.
inline constexpr int kMostRounds = 4;
/// A dot this far from all four places of its cell is none, in 1/65536 spacings: a little less than
/// the places lie from the intersection. Half or twice as much: 1,994.
inline constexpr int kFar_q16 = 65536 / 8;
/// Rounds through the dots' nearest places: the second one goes through what the first makes
/// better.
inline constexpr int kPlaceRounds = 2;
}  // namespace refine_grid

/// The first grid of the second attempt, from the periodogram (lattice/periodogram_search).
namespace periodogram_search {
/// Dots within so many spacings along each axis are summed up at first: the fewer cells, the
/// broader the peak that the raster has to meet. Then within more, which makes it exact. With 3 at
/// first: 1,964; with 10: 1,993.
inline constexpr int kNear_cells = 5;
inline constexpr int kWider_cells = 8;
/// The raster around the first estimate: degrees a step, steps of the spacing's parts, and how many
/// of these to either side.
inline constexpr int kTurn_deg = 2;
inline constexpr int kStretchPart = 40;
inline constexpr int kStretches = 4;
/// The raster in which each of the two directions is then looked for by itself, as a tilted camera
/// sees them: up to 9 degrees and 12 % of the spacing to either side. At a tilt of 30 degrees one
/// spacing is 13 % shorter than the other.
inline constexpr int kTiltTurn_deg = 3;
inline constexpr int kTiltStretchPart = 25;
inline constexpr int kTiltSteps = 3;
/// First steps of the climb, degrees and part of the spacing; the last are an eighth of these.
inline constexpr int kFirstTurn_deg = 1;
inline constexpr int kFirstStretchPart = 80;
inline constexpr int kFinest = 8;
}  // namespace periodogram_search

/// The grid of a patch (lattice/outwards).
namespace outwards {
/// Dots below which a patch is left: six lines of six cells, with 36 dots, are the fewest that
/// carry a position.
inline constexpr int kFewestDots = 40;
/// Dots near the middle whose waves are looked at: of fewer, chance makes waves as strong, and more
/// would take longer, in each of 12 directions, than they make the waves clearer.
inline constexpr int kFewestCentralDots = 14;
inline constexpr int kMostCentralDots = 64;
/// Of the power that a grid without displacements would have: enough to stop, and enough to go on.
inline constexpr float kClearWaves = 0.2F;
inline constexpr float kFaintWaves = 0.12F;
/// Spacings of the smoothed patch, in its own px: finer grids melt together, and in coarser ones
/// dots are not minima but areas.
inline constexpr float kFinest_px = 5.2F;
inline constexpr float kCoarsest_px = 40;
/// Half the spacing, or twice, and the fit went astray; the same where the plane folds so far.
inline constexpr float kLeastSpacing = 0.7F;
inline constexpr float kMostSpacing = 1.4F;
inline constexpr float kMostFold = 0.7F;
/// Spacings within which the first rounds take dots for displaced by chance, and how far from an
/// intersection a dot may then lie.
inline constexpr float kFirstReach = 3;
inline constexpr float kFirstMostOff = 0.42F;
/// Displacements that a first grid is taken to have, spacings: those that docs/limits.md allows,
/// 0.12 to 0.30, and a little more.
inline constexpr float kLeastDisplacement = 0.11F;
inline constexpr float kMostDisplacement = 0.32F;
/// Circles around the four places: parts of the displacement, and spacings at most. Wider ones
/// would leave hardly any room between them.
inline constexpr float kMostOffPart = 0.75F;
inline constexpr float kMostOff = 0.18F;
/// A round in which so few dots count has no plane, and one of which so small a share sits well is
/// given up.
inline constexpr float kFewestUsed = 12;
inline constexpr float kLeastShare = 0.4F;
inline constexpr int kMostRounds = 16;
/// How much farther the next round reaches, by the share of dots that sit well: a plane that is not
/// right yet is made better where it is best.
inline constexpr float kWellShare = 0.9F;
inline constexpr float kWellGrowth = 1.8F;
inline constexpr float kFairShare = 0.8F;
inline constexpr float kFairGrowth = 1.25F;
inline constexpr float kPoorGrowth = 0.8F;
}  // namespace outwards

}  // namespace dotpose::core::tuning
