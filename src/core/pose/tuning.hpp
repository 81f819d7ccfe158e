// Tuning: numbers of the pose's fit that were found by trying rather than derived. Those of the
// second attempt were found on the hard frames that decode/tuning.hpp names. Where a comment says
// what other values do, it gives frames located and the median and 95 % of their errors by `dotpose
// evaluate --preset hard --frames 2000 --seed 404`: 1,994, 2.21 and 5.42 µm with the values as they
// are.
#pragma once

namespace dotpose::core::tuning {

/// Centres of dots through a window (pose/measure).
namespace measure {
/// Half the window in 1/32 of the spacing, but at least kLeastHalf_q8 (1/256 px). The window's rim
/// is paper even where the dot is displaced away from the middle, and no other dot reaches in.
inline constexpr int kHalf_32nds = 9;
inline constexpr int kLeastHalf_q8 = 768;
/// Width (one sigma) of the dot looked for in 1/128 of the spacing, but at least kLeastSigma_q8
/// (1/256 px): as wide as blur makes it. With 6: 1,994, 2.19 and 5.36 µm; with 24: 1,904, 3.58 and
/// 9.19 µm.
inline constexpr int kSigma_128ths = 12;
inline constexpr int kLeastSigma_q8 = 230;
/// Sigmas that a dot may lie off, squared. The fit tells dirt from badly printed dots; a closer
/// limit would cut off the latter, which costs accuracy and hides how badly they are printed.
inline constexpr int kFarthest_2 = 9;
/// Most steps of Gauss and Newton. A step of less than kSettled_q8 (1/256 px) is the last.
inline constexpr int kMostIterations = 5;
inline constexpr int kSettled_q8 = 4;
/// A dot is dropped if its darkness is below half, or above so many halves, of the typical one's:
/// paper where a dot is missing, dirt, graphics.
inline constexpr int kTooDark_halves = 3;
/// Most dots whose median darkness is taken for the typical one.
inline constexpr int kMedianSample = 256;
}  // namespace measure

/// The pose from all dots (pose/refine_pose, pose/float_fit).
namespace fit {
/// Most rounds of Gauss and Newton in `refine_pose` and in `fit_plane`.
inline constexpr int kMostRounds = 4;
inline constexpr int kMostRoundsOfFloats = 5;
/// A step as small as this, in squared deviations of the pose, needs no other after it: the next
/// would be much smaller still.
inline constexpr float kSettled = 0.01F;
/// Dots beyond so many medians of the squared distances are left out. The median is 1.39 sigma^2,
/// so 12 of them lie 4 sigma out, where 1 dot in 3,000 is lost by chance.
inline constexpr int kOutlier_medians = 12;
/// Dots beyond so many variances are left out, where the variance is known: 1 in 4,000 lies 4.1
/// sigma out.
inline constexpr float kOutlier = 16.6F;
/// Other dots may count if the limit changes by a larger share than this.
inline constexpr float kSameLimit = 0.04F;
/// Largest share of the scatter that is put down to pixel noise.
inline constexpr float kMostByNoise = 0.9F;
/// Fewest dots that a plane is fitted to in vectors.
inline constexpr int kFewestDots = 20;
/// A step below this, in squared deviations of the pose, needs no other round: kBentSettled over
/// the square of how much the plane bends (a fifth of a deviation left), but at least kLeastSettled
/// and at most kMostSettled.
inline constexpr float kLeastSettled = 0.2F;
inline constexpr float kMostSettled = 30;
inline constexpr float kBentSettled = 0.04F;
}  // namespace fit

/// The model dot of a frame (pose/dot_shape).
namespace shape {
/// Prior of the terms: deviation of all dots from where a plane has them; mean and deviation of the
/// variance of blur; deviation of the difference of squared half axes, relative to one of them;
/// mean and deviation of the contrast of ink.
inline constexpr float kOff_px = 0.1F;
inline constexpr float kBlur_2 = 0.25F;
inline constexpr float kSigmaOfWidth = 0.3F;
inline constexpr float kContrast = 0.8F;
inline constexpr float kSigmaOfContrast = 0.15F;
/// Least squared half axis, and variance of blur.
inline constexpr float kLeast_px2 = 0.005F;
/// Damping of the steps: at first, the most, and its growth after a step that led astray.
inline constexpr float kFirstDamping = 0.01F;
inline constexpr float kMostDamping = 1e4F;
inline constexpr float kDampingGrows = 10;
/// A gain below this, in squared deviations, is the last.
inline constexpr float kSettled = 0.3F;
inline constexpr int kMostRounds = 30;
}  // namespace shape

/// The bias of dots that fall on the pixels alike (pose/pixel_bias).
namespace facing {
/// Deviations by which the mean pull of facing dots must differ from none.
inline constexpr float kSure = 4;
}  // namespace facing

namespace bias {
/// Dots whose images are added up, as many as show their shape.
inline constexpr int kDots = 256;
/// Pixels count so far beyond the edge of a dot: as far as blur takes it there.
inline constexpr float kBeyondEdge_px = 1.5F;
/// Variance of the blur above which there is hardly any bias.
inline constexpr float kBlurred_px2 = 0.7F * 0.7F;
/// Variance of the bias, relative to its square, that a model dot leaves: of good dots, and for
/// each variance of noise by which dots misfit beyond kMisfit, as those do that are not round.
inline constexpr float kOfModel = 0.01F;
inline constexpr float kMisfit = 2.5F;
inline constexpr float kOfMisfit = 0.025F;
/// Difference between the slopes along both axes, relative to one, that noise makes of round dots.
inline constexpr float kSlopes = 0.03F;
}  // namespace bias

/// Whether dots are off alike (pose/uneven, pose/float_fit).
namespace uneven {
/// Deviations by which blocks share residuals. Attempts that must be fast look for a line beyond
/// kSuspect; the second attempt, whose dots are noisier, beyond kMaybeLine: a step at a line may
/// leave hardly more, as the plane takes up most of it. One flat sheet in twenty exceeds kShared,
/// from where on what blocks share widens the covariance. One side of a line is not even beyond
/// kSuspect, and without a line, a sheet is not beyond kUneven, which hardly one flat sheet in
/// 1,000 exceeds. `dotpose_tables slips` measures it.
inline constexpr float kMaybeLine = 0.9F;
/// Dots up to which kMaybeLine holds; of more, what they share on any sheet shows more.
inline constexpr float kMaybeLineDots = 200;
inline constexpr float kShared = 2.1F;
inline constexpr float kSuspect = 3.5F;
inline constexpr float kUneven = 5;
/// Number of outliers that chance explains, plus a share of the dots.
inline constexpr float kFewOutliers = 3;
inline constexpr float kShareOfOutliers = 0.02F;
/// Blocks along each side for at most kManyDots dots; for more there are nine. Of 170 dots each
/// block has five.
inline constexpr int kManyDots = 1000;
inline constexpr int kFewAlong = 6;
/// Variance that uneven blocks add to place and turn, in variances of what a block is off.
/// docs/integrity.md has what fixes claim on sheets that are bent.
inline constexpr float kOfPlace = 2;
inline constexpr float kOfTurn = 8;
/// Deviation of what blocks share that is not put down to the sheet: the bias of dots whose places
/// drift slowly through a pixel, which averages out over the view.
inline constexpr float kPixelBias_px = 0.004F;
/// Either side may hold the reference point if it is within so many spacings of the line.
inline constexpr float kNearLine = 1.2F;
}  // namespace uneven

/// The line that divides a sheet (pose/slip, pose/sides).
namespace slip {
/// Most that a dot says for a plane that it lies on: natural log odds against dots anywhere in
/// their cells.
inline constexpr float kOnPlane = 5;
/// Dots of one part may lie so many deviations (squared) from where the other part has them, for
/// its displacement to be found.
inline constexpr float kTogether = 36;
/// Spacings by which the reference point may lie beyond the line, and fewest dots beyond it.
inline constexpr float kBehind = 0.5F;
inline constexpr float kFewestBeyond = 12;
/// Dots at most this far off, in spacings^2, count in the first round of a fit to one side, which
/// starts from a plane fitted to both.
inline constexpr float kFarOff = 0.04F;
/// Dots within so many spacings of the line count for neither side, as the line is known to about a
/// spacing.
inline constexpr float kMargin = 0.8F;
/// The residual that dots beyond the line share is found within kReach spacings of the reference
/// point, from at least kFewestAlike dots that agree to kAlike (spacings^2).
inline constexpr float kReach = 10;
inline constexpr int kFewestAlike = 8;
inline constexpr float kAlike = 0.08F * 0.08F;
/// Rounds of looking for the line and fitting the dots on this side.
inline constexpr int kRounds = 3;
}  // namespace slip

}  // namespace dotpose::core::tuning
