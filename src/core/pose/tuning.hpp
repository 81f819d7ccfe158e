// Tuning: empirical constants for the pose fit. The constants for the second attempt were
// determined on the hard frames listed in decode/tuning.hpp. Some comments state the results with
// other values of a constant: the number of located frames, and the median and 95th percentile of
// the position errors. These results are printed by the command
//
//     dotpose evaluate --preset hard --frames 2000 --seed 404
//
// With the values in this file, the results are 1,994 frames, 2.21 µm and 5.42 µm.
#pragma once

namespace dotpose::core::tuning {

/// Measurement of dots in a window (pose/measure).
namespace measure {
/// Half-width of the window, in units of 1/32 of the spacing, and its minimum, in 1/256 px. At this
/// size, the window border is on blank paper even if the dot is off centre, and the window contains
/// no other dot.
inline constexpr int kHalf_32nds = 9;
inline constexpr int kMinHalf_q8 = 768;
/// Standard deviation of the Gaussian that is fitted to a dot, in units of 1/128 of the spacing,
/// and its minimum, in 1/256 px. kSigma_128ths corresponds to a typical blurred dot. If
/// kSigma_128ths is 6, the results are 1,994 frames, 2.19 µm and 5.36 µm. If kSigma_128ths is 24,
/// the results are worse: 1,904 frames, 3.58 µm and 9.19 µm.
inline constexpr int kSigma_128ths = 12;
inline constexpr int kMinSigma_q8 = 230;
/// Maximum squared distance between a dot and its predicted image position, in units of sigma^2.
/// The limit is large, because the pose fit rejects dirt as outliers. A smaller limit would also
/// reject badly printed dots, so the pose would be less accurate and the residuals would not show
/// the print errors.
inline constexpr int kFarthest_2 = 9;
/// Maximum number of Gauss-Newton iterations. The fit ends early after a step shorter than
/// kSettled_q8 / 256 px.
inline constexpr int kMaxIterations = 5;
inline constexpr int kSettled_q8 = 4;
/// Maximum mass of a dot, in units of half the typical mass. The minimum is half the typical mass.
/// These limits reject dirt, graphics, and bare paper where a dot is missing.
inline constexpr int kTooDark_halves = 3;
/// Maximum number of dots sampled for the typical mass, which is the median of their masses.
inline constexpr int kMedianSample = 256;
}  // namespace measure

/// Pose fit to all dots (pose/refine_pose, pose/float_fit).
namespace fit {
/// Maximum number of Gauss-Newton iterations in `refine_pose` (kMaxRounds) and `fit_plane`
/// (kMaxRoundsOfFloats).
inline constexpr int kMaxRounds = 4;
inline constexpr int kMaxRoundsOfFloats = 5;
/// `refine_pose` stops if `moved`, the squared length of the whitened step (see `solve` in
/// fit/solve_plane.hpp), is at most this value, because the next step would be much smaller.
inline constexpr float kSettled = 0.01F;
/// Outlier limit for squared residuals, in units of their median. The median is 1.39 sigma^2, where
/// sigma is the standard deviation of one coordinate, so the limit for the residual is 4.1 sigma.
/// By chance, 1 dot in 4,000 exceeds this limit.
inline constexpr int kOutlier_medians = 12;
/// Outlier limit for squared residuals, in units of the known variance of one coordinate. The limit
/// for the residual is 4.1 standard deviations. By chance, 1 dot in 4,000 exceeds this limit.
inline constexpr float kOutlier = 16.6F;
/// Minimum relative change of the outlier limit. If the change is smaller, the inliers are assumed
/// to be unchanged.
inline constexpr float kSameLimit = 0.04F;
/// Maximum fraction of the residual variance that is attributed to pixel noise.
inline constexpr float kMaxByNoise = 0.9F;
/// Minimum number of dots for `fit_plane`.
inline constexpr int kMinDots = 20;
/// `fit_plane` has converged if `moved` is below a limit. The limit is kNonlinearSettled / n^2,
/// clamped to [kMinSettled, kMaxSettled], where n is the nonlinearity of the plane (see `settled`
/// in float_fit.cpp). After the last step, the remaining error is about a fifth of a standard
/// deviation.
inline constexpr float kMinSettled = 0.2F;
inline constexpr float kMaxSettled = 30;
inline constexpr float kNonlinearSettled = 0.04F;
}  // namespace fit

/// Fit of the model dot (pose/dot_shape).
namespace shape {
/// Prior: standard deviation of the common offset of all dots, along each axis.
inline constexpr float kOff_px = 0.1F;
/// Prior: mean of the blur variance, in px^2. The standard deviation has the same value.
inline constexpr float kBlur_2 = 0.25F;
/// Limits for the blur variance at which the fit begins.
inline constexpr float kMinFirstBlur_2 = 0.1F;
inline constexpr float kMaxFirstBlur_2 = 1;
/// Prior: standard deviation of the relative difference between the squared semi-axes.
inline constexpr float kSigmaOfWidth = 0.3F;
/// Prior: mean and standard deviation of the ink contrast, as fractions of the paper level.
inline constexpr float kContrast = 0.8F;
inline constexpr float kSigmaOfContrast = 0.15F;
/// Lower limit for the squared semi-axes and for the blur variances.
inline constexpr float kMin_px2 = 0.005F;
/// Damping of the steps: initial value, maximum, and factor after a rejected step.
inline constexpr float kFirstDamping = 0.01F;
inline constexpr float kMaxDamping = 1e4F;
inline constexpr float kDampingGrows = 10;
/// The fit ends if an iteration reduces the cost by less than kSettled, or after kMaxRounds
/// iterations. The cost is the sum of squared residuals in units of their variances. With three
/// iterations, the errors in the table `dotpose_tables alike` are the same, except for the smallest
/// and sharpest dots (11 px per spacing, dots of 0.10, blur 0.3 px: 0.0044 instead of 0.0051 px).
inline constexpr float kSettled = 0.3F;
inline constexpr int kMaxRounds = 2;
}  // namespace shape

/// Bias of facing dots (pose/facing_dots).
namespace facing {
/// Minimum ratio of a bias to its standard deviation. A smaller bias is not significant, and is not
/// corrected.
inline constexpr float kSure = 4;
}  // namespace facing

/// Pixel bias of dots with the same sub-pixel phase (pose/pixel_bias).
namespace bias {
/// kDots is the maximum number of stacked dots. The dot shape is fitted to the fullest stacks: as
/// many as contain kEnoughDots dots, but at most kStacks. With 256 dots in 16 stacks, the errors in
/// the table `dotpose_tables alike` are the same.
inline constexpr int kDots = 128;
inline constexpr float kEnoughDots = 48;
inline constexpr std::size_t kStacks = 4;
/// Width of the border around a dot. The stacked images include this border, because it contains
/// the blurred edge of the dot.
inline constexpr float kBeyondEdge_px = 1.5F;
/// Maximum blur variance for which the bias is corrected. If the variance exceeds this limit along
/// both axes, the bias is negligible, and dots may be larger than the model image.
inline constexpr float kBlurred_px2 = 1.2F;
/// Uncertainty of the bias correction. The variance of the remaining bias is f a^2, where a is the
/// amplitude of the computed bias and f is kOfModel + kOfMisfit * max(misfit - kMisfit, 0). misfit
/// is `DotShape::misfit()`. For round dots, the second term of f is 0.
inline constexpr float kOfModel = 0.01F;
inline constexpr float kMisfit = 2.5F;
inline constexpr float kOfMisfit = 0.025F;
/// Scale of the shrinkage in `AxisBias::slope_ratio`. For round dots, noise typically causes a
/// relative difference of this size between the moment slopes along u and v.
inline constexpr float kSlopes = 0.03F;
}  // namespace bias

/// Correlation of residuals (pose/uneven).
namespace uneven {
/// Limits for the scatter between blocks. The limits apply to `GroupScatter::excess`, in standard
/// deviations. `dotpose_tables slips` measures the fraction of flat sheets above each limit.
/// - kMaybeLine: above this limit, the second attempt searches for a line that divides the sheet.
///   The limit is low because the plane fitted to all dots absorbs most of a step, and because dot
///   centres measured in the second attempt are noisier than those from the other attempts.
/// - kShared: above this limit, the mean block residuals increase the covariance. 1 in 20 flat
///   sheets exceeds this limit.
/// - kSuspect: above this limit, the first and tracked attempts search for a line. The dots on the
///   reference point's side of a line are assumed to be in one plane if their scatter is below this
///   limit.
/// - kUneven: above this limit, a sheet that is not divided by a line is considered uneven. At most
///   about 1 in 1,000 flat sheets exceeds this limit.
inline constexpr float kMaybeLine = 0.9F;
/// Maximum number of dots for which the second attempt uses kMaybeLine as the limit. With more
/// dots, the limit is kMaybeLine * sqrt(dots / kMaybeLineDots), because more dots make block
/// residuals statistically more significant, even on flat sheets.
inline constexpr float kMaybeLineDots = 200;
inline constexpr float kShared = 2.1F;
inline constexpr float kSuspect = 3.5F;
inline constexpr float kUneven = 5;
/// Maximum number of outliers that is normal on a flat sheet: kFewOutliers plus kOutlierFraction
/// times the number of dots.
inline constexpr float kFewOutliers = 3;
inline constexpr float kOutlierFraction = 0.02F;
/// Number of dots above which each image side is divided into nine blocks. With fewer dots, each
/// image side is divided into at most kFewAlong blocks.
inline constexpr int kManyDots = 1000;
/// Limits on the number of blocks along each image side if there are at most kManyDots dots. Within
/// these limits, the number is the largest for which a block contains at least kDotsPerBlock dots
/// on average. With only one or two dots per block, the scatter within blocks could not be
/// estimated reliably, and flat sheets would seem uneven.
inline constexpr int kMinAlong = 2;
inline constexpr int kFewAlong = 6;
inline constexpr int kDotsPerBlock = 4;
/// Factors for the additional pose variance due to block displacements. Let v be the variance of
/// the displacement of a block along one axis, and s the block side. The pose variance grows by
/// kOfPlace * v for x and for y, and by kOfTurn * v / s^2 for the angle. docs/integrity.md compares
/// the result with the errors on bent sheets.
inline constexpr float kOfPlace = 2;
inline constexpr float kOfTurn = 8;
/// Standard deviation of the mean block residuals due to pixel bias. If the sub-pixel phase of the
/// dots changes slowly across the view, the bias differs between blocks, but it averages out over
/// the view and is therefore not evidence of an uneven sheet.
inline constexpr float kPixelBias_px = 0.004F;
/// Maximum distance from the reference point to the dividing line, in spacings, at which the
/// reference point may be on either side of the line.
inline constexpr float kNearLine = 1.2F;
}  // namespace uneven

/// Search for a line that divides a sheet (pose/paper_step, pose/split_fit).
namespace paper_step {
/// Maximum evidence that one dot provides for a plane. The evidence is the natural log of the odds
/// that the dot is where the plane predicts it, rather than at a random position in its cell.
inline constexpr float kOnPlane = 5;
/// Maximum squared residual that a displaced part of the sheet can explain, in units of the
/// residual variance.
inline constexpr float kTogether = 36;
/// Maximum distance of the reference point beyond the line, in spacings.
inline constexpr float kBehind = 0.5F;
/// Minimum number of dots beyond the line.
inline constexpr float kMinBeyond = 12;
/// Outlier limit in the first iteration of a fit to one side, in spacings^2. The limit is large,
/// because this iteration starts from a plane fitted to both sides.
inline constexpr float kFarOff = 0.04F;
/// Minimum distance of a dot from the line, in spacings. Dots closer to the line belong to neither
/// side, because the position of the line is uncertain by about this distance.
inline constexpr float kMargin = 0.8F;
/// Parameters of the search for a residual that the dots beyond the line have in common. The search
/// uses the dots within kReach spacings of the reference point along each axis. A residual agrees
/// with the common residual if their squared difference is less than kAgreement, in spacings^2. At
/// least kMinAgreeing residuals must agree.
inline constexpr float kReach = 10;
inline constexpr int kMinAgreeing = 8;
inline constexpr float kAgreement = 0.08F * 0.08F;
/// Number of iterations in `fit_this_side`. Each iteration fits a plane to the reference point's
/// side. Each iteration except the last then searches for the line again. Below kFewDots dots,
/// there is only one iteration: on displaced sheets at 9 px per spacing, in views of 96 x 96 px,
/// three iterations increase the 95 % quantile of the error from 6.5 to 7.7 µm.
inline constexpr int kRounds = 3;
inline constexpr int kFewDots = 144;
}  // namespace paper_step

/// Rotation during the readout of a rolling shutter (pose/turn_fit).
namespace turn {
/// Steps for numerical derivatives. The rotation step moves dots in the image corners by kStep_px.
/// The drift step is kDriftStep, in px per row.
inline constexpr float kStep_px = 0.3F;
inline constexpr float kDriftStep = 0.02F;
/// Standard deviation of the drift that `drift_of` computes from the plane, in px per row. A camera
/// tilt of 6 degrees foreshortens the paper by 0.5 %, which looks like a drift of 0.005, and a tilt
/// of 14 degrees looks like a drift of 0.03. kDriftOfTilt is the increase per squared relative
/// change in scale from the centre to the outermost dot. A tilt of 2 degrees changes the scale by
/// 1 %. For cameras with a narrow field of view, it changes the scale by less, and the standard
/// deviation is too small for large tilts.
inline constexpr float kDrift = 0.005F;
inline constexpr float kDriftOfTilt = 50;
inline constexpr float kMaxDrift = 0.03F;
}  // namespace turn

}  // namespace dotpose::core::tuning
