// Tuning: empirical constants of the pose fit. The constants of the second attempt were determined
// on the hard frames that decode/tuning.hpp names. Comments that compare values state the number of
// frames that `dotpose evaluate --preset hard --frames 2000 --seed 404` locates, and the median and
// the 95 % quantile of their errors. With the values in this file, these numbers are 1,994 frames,
// 2.21 µm and 5.42 µm.
#pragma once

namespace dotpose::core::tuning {

/// Centres of dots in a window (pose/measure).
namespace measure {
/// Half the side of the window, in 1/32 of the spacing, and its minimum, in 1/256 px. At this size,
/// the border of the window is on paper even if the dot is not in the middle of the window, and the
/// window contains no part of another dot.
inline constexpr int kHalf_32nds = 9;
inline constexpr int kMinHalf_q8 = 768;
/// Standard deviation of the fitted dot, in 1/128 of the spacing, and its minimum, in 1/256 px.
/// kSigma_128ths is the width of a blurred dot. With kSigma_128ths = 6, 1,994 of the 2,000 frames
/// are located, with a median error of 2.19 µm and a 95 % quantile of 5.36 µm. With kSigma_128ths =
/// 24, only 1,904 frames are located, with 3.58 µm and 9.19 µm.
inline constexpr int kSigma_128ths = 12;
inline constexpr int kMinSigma_q8 = 230;
/// Maximum squared distance of a dot from its place, in units of sigma^2. The pose fit rejects dirt
/// as outliers, so the limit can be large. A smaller limit would also reject badly printed dots,
/// which costs accuracy and hides print errors.
inline constexpr int kFarthest_2 = 9;
/// Maximum number of Gauss-Newton iterations. The fit also ends after a step that is shorter than
/// kSettled_q8, in 1/256 px.
inline constexpr int kMaxIterations = 5;
inline constexpr int kSettled_q8 = 4;
/// Maximum darkness of a dot, in halves of the darkness of a typical dot. The minimum is half the
/// darkness of a typical dot. These limits reject dirt, graphics, and bare paper where a dot is
/// missing.
inline constexpr int kTooDark_halves = 3;
/// Maximum number of dots in the sample whose median is used as the darkness of a typical dot.
inline constexpr int kMedianSample = 256;
}  // namespace measure

/// The pose from all dots (pose/refine_pose, pose/float_fit).
namespace fit {
/// Maximum number of Gauss-Newton iterations in `refine_pose` and in `fit_plane`, respectively.
inline constexpr int kMaxRounds = 4;
inline constexpr int kMaxRoundsOfFloats = 5;
/// Squared step length, in units of the standard deviation of the pose, at or below which
/// `refine_pose` stops. The next step would be much smaller.
inline constexpr float kSettled = 0.01F;
/// Outlier limit of squared residuals, in units of their median. The median is 1.39 sigma^2, so the
/// limit is 4.1 sigma. By chance, 1 dot in 4,000 exceeds the limit.
inline constexpr int kOutlier_medians = 12;
/// Outlier limit of squared residuals, in units of the variance, if the variance is known. The
/// limit is 4.1 sigma. By chance, 1 dot in 4,000 exceeds the limit.
inline constexpr float kOutlier = 16.6F;
/// Relative change of the limit below which the inliers count as unchanged.
inline constexpr float kSameLimit = 0.04F;
/// Maximum fraction of the scatter that is attributed to pixel noise.
inline constexpr float kMaxByNoise = 0.9F;
/// Minimum number of dots for `fit_plane`.
inline constexpr int kMinDots = 20;
/// Squared length of a step, in units of the standard deviation of the pose, below which the fit
/// has converged: kNonlinearSettled / n^2, where n is the nonlinearity of the plane (`settled` in
/// float_fit.cpp), clamped to [kMinSettled, kMaxSettled]. After the last step, the remaining error
/// is about a fifth of a standard deviation.
inline constexpr float kMinSettled = 0.2F;
inline constexpr float kMaxSettled = 30;
inline constexpr float kNonlinearSettled = 0.04F;
}  // namespace fit

/// Fit of the model dot of a frame (pose/dot_shape).
namespace shape {
/// Prior: standard deviation of the common offset of all dots along each axis.
inline constexpr float kOff_px = 0.1F;
/// Prior: mean and standard deviation of the variance of the blur, in px^2.
inline constexpr float kBlur_2 = 0.25F;
/// Prior: standard deviation of the relative difference of the squared half axes.
inline constexpr float kSigmaOfWidth = 0.3F;
/// Prior: mean and standard deviation of the contrast of ink.
inline constexpr float kContrast = 0.8F;
inline constexpr float kSigmaOfContrast = 0.15F;
/// Minimum of the squared half axes and of the variance of the blur.
inline constexpr float kMin_px2 = 0.005F;
/// Damping of the steps: initial value, maximum, and factor after a rejected step.
inline constexpr float kFirstDamping = 0.01F;
inline constexpr float kMaxDamping = 1e4F;
inline constexpr float kDampingGrows = 10;
/// The fit ends after kMaxRounds iterations, or after a step that reduces the cost by less than
/// kSettled. The cost is the sum of the squared residuals, in units of their variances.
inline constexpr float kSettled = 0.3F;
inline constexpr int kMaxRounds = 30;
}  // namespace shape

/// The bias of facing dots (pose/facing_dots).
namespace facing {
/// Minimum significance, in standard deviations, at which the bias of facing dots is corrected.
inline constexpr float kSure = 4;
}  // namespace facing

/// The pixel bias of dots with the same sub-pixel phase (pose/pixel_bias).
namespace bias {
/// Maximum number of dots whose images are stacked. This number suffices to determine the shape of
/// the dots.
inline constexpr int kDots = 256;
/// Width of the border around a dot that is also stacked. The border contains the blur of the edge
/// of the dot.
inline constexpr float kBeyondEdge_px = 1.5F;
/// Variance of the blur above which the bias is negligible.
inline constexpr float kBlurred_px2 = 0.7F * 0.7F;
/// Variance of the bias that remains after correction with a model dot, divided by the squared
/// bias: kOfModel + kOfMisfit * max(misfit - kMisfit, 0), where misfit is `DotShape::misfit()`.
/// Round dots need only kOfModel.
inline constexpr float kOfModel = 0.01F;
inline constexpr float kMisfit = 2.5F;
inline constexpr float kOfMisfit = 0.025F;
/// Relative difference between the slopes along the two axes that noise alone causes for round
/// dots.
inline constexpr float kSlopes = 0.03F;
}  // namespace bias

/// Correlation of residuals (pose/uneven).
namespace uneven {
/// Limits of the excess of the scatter between blocks over chance, in standard deviations:
/// - kMaybeLine: above this limit, the second attempt searches for a line that divides the sheet.
///   The limit is low because the plane absorbs most of a step at a line. The dots of the second
///   attempt are noisier than the dots of fast attempts.
/// - kShared: above this limit, the common residuals increase the covariance. For 1 in 20 flat
///   sheets, the excess is above this limit.
/// - kSuspect: above this limit, fast attempts search for a line. Up to this limit, one side of a
///   line counts as even.
/// - kUneven: above this limit, a sheet without a line counts as uneven. For at most about 1 in
///   1,000 flat sheets, the excess is above this limit.
///
/// `dotpose_tables slips` measures these fractions.
inline constexpr float kMaybeLine = 0.9F;
/// Number of dots up to which kMaybeLine applies. With more dots, the limit increases with the
/// square root of their number, because the common residuals of any sheet are more significant.
inline constexpr float kMaybeLineDots = 200;
inline constexpr float kShared = 2.1F;
inline constexpr float kSuspect = 3.5F;
inline constexpr float kUneven = 5;
/// Number of outliers that chance explains: a constant plus a fraction of the dots.
inline constexpr float kFewOutliers = 3;
inline constexpr float kOutlierFraction = 0.02F;
/// Maximum number of dots for which each side of the image is divided into kFewAlong blocks. With
/// more dots, each side is divided into nine blocks.
inline constexpr int kManyDots = 1000;
/// Number of blocks along each side of the image, for at most kManyDots dots: the largest number,
/// from kMinAlong to kFewAlong, with kDotsPerBlock dots in each block. If blocks contain only one
/// or two dots, the scatter within blocks is unknown, and flat sheets seem uneven.
inline constexpr int kMinAlong = 2;
inline constexpr int kFewAlong = 6;
inline constexpr int kDotsPerBlock = 4;
/// Factors by which the variance of the displacement of a block, along one axis, is added to the
/// covariance of the pose: kOfPlace * variance for x and for y, and kOfTurn * variance / side^2 for
/// the angle, where side is the side of a block. docs/integrity.md compares the result with the
/// errors on bent sheets.
inline constexpr float kOfPlace = 2;
inline constexpr float kOfTurn = 8;
/// Standard deviation of the common residuals of blocks that is not attributed to the sheet. These
/// residuals are due to the pixel bias of dots whose phase drifts slowly over the view. The bias
/// averages out over the view.
inline constexpr float kPixelBias_px = 0.004F;
/// Distance from the line, in spacings, within which the reference point may be on either side of
/// the line.
inline constexpr float kNearLine = 1.2F;
}  // namespace uneven

/// Search for the line that divides a sheet (pose/paper_step, pose/split_fit).
namespace paper_step {
/// Maximum evidence of one dot for a plane that predicts its place: natural logarithm of the odds
/// relative to a dot at a random place in its cell.
inline constexpr float kOnPlane = 5;
/// Maximum squared residual of a dot, in units of the variance, that a common displacement of its
/// part of the sheet may explain.
inline constexpr float kTogether = 36;
/// Maximum distance, in spacings, by which the reference point may be beyond the line.
inline constexpr float kBehind = 0.5F;
/// Minimum number of dots beyond the line.
inline constexpr float kMinBeyond = 12;
/// Outlier limit, in spacings^2, in the first iteration of a fit to one side. This iteration starts
/// from a plane fitted to both sides.
inline constexpr float kFarOff = 0.04F;
/// Distance from the line, in spacings, within which dots belong to neither side. The distance is
/// the uncertainty of the line.
inline constexpr float kMargin = 0.8F;
/// Search for the common residual of the dots beyond the line. Uses the dots within kReach spacings
/// of the reference point. At least kMinAgreeing of these dots must agree within kAgreement
/// (spacings^2).
inline constexpr float kReach = 10;
inline constexpr int kMinAgreeing = 8;
inline constexpr float kAgreement = 0.08F * 0.08F;
/// Number of iterations. Each iteration fits a plane to the dots on the side of the reference
/// point. Each iteration except the last then searches for the line again.
inline constexpr int kRounds = 3;
}  // namespace paper_step

/// Rotation during the readout of a rolling shutter (pose/turn_fit).
namespace turn {
/// Steps with which derivatives are computed: the distance by which the dots in the corners move,
/// and the drift, as a fraction.
inline constexpr float kStep_px = 0.3F;
inline constexpr float kDriftStep = 0.02F;
/// Standard deviation of the drift that is computed from the plane: a camera that is tilted by 14
/// degrees sees the paper shortened by 3 %.
inline constexpr float kDrift = 0.02F;
}  // namespace turn

}  // namespace dotpose::core::tuning
