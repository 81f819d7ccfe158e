// Tuning: the numbers of fitting the pose that were found by trying rather than derived. Those of
// the second attempt were found on the hard frames that decode/tuning.hpp names; where a line says
// what other values do, these are frames located, and the median and 95 % of their errors, by
// `dotpose evaluate --preset hard --frames 2000 --seed 404`: 1,994, 2.21 and 5.42 µm with the
// values as they are.
#pragma once

namespace dotpose::core::tuning {

/// Centres of dots through a window (pose/measure).
namespace measure {
/// Half the window, in 1/32 of the spacing: its rim is paper even where the dot is displaced away
/// from the middle, and no other dot reaches in. Not below kLeastHalf_q8 px.
inline constexpr int kHalf_32nds = 9;
inline constexpr int kLeastHalf_q8 = 768;
/// Width of the dot looked for, one sigma, in 1/128 of the spacing: as wide as blur has made it.
/// Not below kLeastSigma_q8 px. With 6: 1,994, 2.19 and 5.36 µm; with 24: 1,904, 3.58 and 9.19 µm.
inline constexpr int kSigma_128ths = 12;
inline constexpr int kLeastSigma_q8 = 230;
/// Sigmas that a dot may lie off, squared. The fit tells dirt from dots that were printed badly; a
/// closer limit would cut off the tail of these, which costs accuracy and hides how much it was.
inline constexpr int kFarthest_2 = 9;
/// Steps of Gauss and Newton; a step below so many 1/256 px is the last.
inline constexpr int kMostIterations = 5;
inline constexpr int kSettled_q8 = 4;
/// A dot is dropped below one half and above so many halves of the typical one's darkness: paper
/// where a dot is missing, dirt, graphics.
inline constexpr int kTooDark_halves = 3;
/// Dots that tell what is typical.
inline constexpr int kMedianSample = 256;
}  // namespace measure

/// The pose from all dots (pose/refine_pose, pose/float_fit).
namespace fit {
/// Rounds of Gauss and Newton, at most.
inline constexpr int kMostRounds = 4;
inline constexpr int kMostRoundsOfFloats = 5;
/// A step so small, in squared deviations of the pose, needs no other after it: it would be smaller
/// by far.
inline constexpr float kSettled = 0.01F;
/// Dots beyond so many medians of the squared distances are left out: these have their median at
/// 1.39 sigma^2, so that 12 of them lie 4 sigma out, where 1 dot in 3,000 is lost by chance.
inline constexpr int kOutlier_medians = 12;
/// The same in variances, where these are known: 1 in 4,000 lies 4.1 sigma out.
inline constexpr float kOutlier = 16.6F;
/// The largest share of the scatter that is put down to noise.
inline constexpr float kMostByNoise = 0.9F;
/// Dots below which a view is not fitted in vectors.
inline constexpr int kFewestDots = 20;
/// How far a plane may be off for the next round to be spared, in squared deviations: at least and
/// at most. In between it is this over how much the plane bends, squared: a fifth of a deviation.
inline constexpr float kLeastSettled = 0.2F;
inline constexpr float kMostSettled = 1000;
inline constexpr float kBentSettled = 0.04F;
}  // namespace fit

/// Whether dots are off alike (pose/uneven, pose/float_fit).
namespace uneven {
/// Runs of dots that are off alike by more deviations than this are looked at in blocks; of honest
/// frames few are.
inline constexpr float kSuspectRuns = 2.2F;
/// Blocks likewise: of honest frames 3 % exceed the one, and hardly one in 1,000 the other.
inline constexpr float kSuspect = 2.5F;
inline constexpr float kUneven = 5;
/// Outliers that chance explains, and the share of the dots on top of it.
inline constexpr float kFewOutliers = 3;
inline constexpr float kShareOfOutliers = 0.02F;
/// Blocks along each side, for up to so many dots; nine for more. Of 170 dots a block has five.
inline constexpr int kManyDots = 1000;
inline constexpr int kFewAlong = 6;
/// What blocks that are off alike add to the variance of place and turn, in variances of what a
/// block is off: docs/integrity.md has what fixes claim on sheets that are bent.
inline constexpr float kOfPlace = 2;
inline constexpr float kOfTurn = 8;
/// Spacings of the reference point from a line, within which either side may hold it.
inline constexpr float kNearLine = 1.2F;
}  // namespace uneven

/// The line that divides a sheet (pose/slip, pose/sides).
namespace slip {
/// What a dot says for a plane on which it lies, at most, and against one on which it does not, as
/// natural logarithms of odds against dots that lie anywhere in their cells.
inline constexpr float kOnPlane = 5;
inline constexpr float kOffPlane = -4.5F;
/// Dots of one part lie within so many deviations of where another has them, squared, for its
/// displacement to be told from them.
inline constexpr float kTogether = 36;
/// Spacings by which the reference point may lie beyond the line, and dots that must.
inline constexpr float kBehind = 0.5F;
inline constexpr float kFewestBeyond = 12;
/// Squared spacings within which dots of one side lie of a plane that is fitted to both.
inline constexpr float kFarOff = 0.04F;
/// Spacings around a line in which dots count for neither side: it is known to a spacing or so.
inline constexpr float kMargin = 0.8F;
/// Dots around the reference point that tell what those beyond are off: within so many spacings,
/// at least so many of them, alike within so many spacings, squared.
inline constexpr float kReach = 10;
inline constexpr int kFewestAlike = 8;
inline constexpr float kAlike = 0.08F * 0.08F;
/// Rounds of looking for the line and fitting to the dots on this side.
inline constexpr int kRounds = 3;
}  // namespace slip

}  // namespace dotpose::core::tuning
