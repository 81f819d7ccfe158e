// Tuning: empirical constants of the attempts, with their purpose and, where known, the measurement
// of their effect. The constants of the second attempt were determined on the hard frames listed in
// decode/tuning.hpp.
#pragma once

#include "core/math/float_plane.hpp"

namespace dotpose::core::tuning {

/// Constants of the first attempt (locate/first).
namespace first {
/// Size of the smallest patches: 20 x 14 dots at 11 px per spacing. If these patches contain no
/// readable grid, the search continues with patches of two and four times this width and height.
inline constexpr int kPatchWidth_px = 224;
inline constexpr int kPatchHeight_px = 160;
/// Minimum spacing at which a patch predicts dots precisely enough for direct sampling. Dots of
/// finer grids are measured more accurately without direct sampling.
inline constexpr float kMinSpacingForPrediction_px = 9.5F;
/// Maximum number of uncertain hypotheses away from the image centre. Each uncertain hypothesis
/// increases the probability of a wrong fix.
inline constexpr int kMaxTries = 4;
/// Numbers of central dots in which waves are searched, and factors applied to the estimated
/// spacing, for patches away from the image centre. The search tries all combinations. If large
/// displacements weaken the waves, only some combinations find the grid.
inline constexpr float kCentralDots[] = {30, 20, 45, 25, 37};
inline constexpr float kSpacings[] = {1, 0.965F};
/// Factors of the spacing if sheets are known. On known sheets, a strip of three rows may be
/// certain. Its spacing is overestimated, because the estimate uses the number of dots around a
/// dot.
inline constexpr float kSpacingsOfKnown[] = {1, 0.965F, 0.75F};
}  // namespace first

/// Constants of images in which the scene rotates during the readout (locate/turning).
namespace turning {
/// Maximum rotation during the readout, and maximum distance by which the scene moves down at the
/// side of the image while a row is read, in rows.
inline constexpr float kMaxTurn_rad = 1.2F;
inline constexpr float kMaxFall = 0.95F;
/// Maximum motion of the scene while a row is read, in rows.
inline constexpr float kMaxDrift = 0.9F;
/// Step of the search for the rotation: the distance by which the dots in the corners of the patch
/// move, in spacings. Fraction of this step at which the search ends.
inline constexpr float kStep = 0.4F;
inline constexpr float kStepParts = 32;
/// Minimum ratio of the agreements of a better grid and of the best grid so far.
inline constexpr float kBetter = 1.0005F;
/// Minimum ratio of the squared residuals that the rotation explains to the squared residuals that
/// remain, if the remaining residuals of neighbouring dots are not correlated, and otherwise.
inline constexpr float kMinGainIfEven = 0.5F;
inline constexpr float kMinGain = 3;
/// Maximum variance of the offsets of the dots from the places of their cells, per axis, in
/// spacings^2. In a false grid, the offsets are evenly distributed over circles with a radius of
/// 0.18 spacings, which have a variance of 0.008.
inline constexpr float kMaxVariance = 0.002F;
/// Maximum number of grids whose place is searched. A grid without a place in the code is found
/// again from the next rotations.
inline constexpr int kMaxClimbs = 3;
/// Correction of the rotation below which the image is not measured again: the distance by which
/// the dots in the corners move. Smaller corrections are applied to the measured dots.
inline constexpr float kSettled_px = 0.5F;
inline constexpr int kMaxRounds = 5;
}  // namespace turning

/// Constants of the tracked attempt (locate/tracked).
namespace tracked {
/// Reach along each axis, in spacings, around the point at which a prediction is corrected. The
/// dots within this reach determine the error of the prediction at this point. The reach is small
/// enough that an angular error of the prediction does not match a dot to the wrong intersection.
inline constexpr float kNear = 2.6F;
/// Minimum number of dots from which a correction of the prediction is computed.
inline constexpr int kMinNear = 10;
/// Maximum error of a prediction that the search covers, in spacings. A larger maximum would be
/// useless, because beyond half a spacing a neighbouring dot is closer than the correct dot.
inline constexpr float kMaxOff = 0.6F;
/// Range of spacings, in px, that can be tracked.
inline constexpr float kFinest_px = 5;
inline constexpr float kCoarsest_px = 80;
/// Range of the displacements that are plausible in a prediction, in spacings.
inline constexpr float kMinDisplacement = 0.05F;
inline constexpr float kMaxDisplacement = 0.4F;
/// Maximum distance of a dot from its place in the first and in the second fit, in spacings.
inline constexpr float kFirstOff = 0.30F;
inline constexpr float kSecondOff = 0.15F;
/// Maximum offset of a dot from its predicted place at which the dot is measured in a centroid
/// window.
inline constexpr float kMaxOffset_px = 1.5F;
/// Offset that corresponds to a moment-to-weight ratio of 1 for a typical dot, within 20 %.
inline constexpr float kWeight_px = 0.84F;
/// Shift at the image border, due to the scale or the rotation of a correction, above which the
/// dots are measured again.
inline constexpr float kTurned_px = 2;
/// Maximum number of measurements of the dots in one correction of the prediction.
inline constexpr int kMaxLooks = 3;
/// Points around which dots are searched, relative to the image centre, in fractions of the sides
/// of the image. The pattern may be covered at one point and visible at another point.
inline constexpr FloatVec kPoints[] = {
    {0, 0}, {-0.25F, -0.22F}, {0.25F, 0.22F}, {0.25F, -0.22F}, {-0.25F, 0.22F}};
}  // namespace tracked

/// Constants of the measurement of dots at known places (locate/confirm, locate/dot_reader).
namespace confirm {
/// Reach of the first round, in spacings, if the pattern fills an image that is too large to be
/// measured in one round. All dots within this reach are measured, and their bits must make the
/// position certain.
inline constexpr float kDense = 10;
/// Maximum half side of an image, in spacings, that is measured completely in one round.
inline constexpr float kDenseAtMost = 17;
/// Reach of the first round in a partial view, in spacings. The reach is small because the pattern
/// of a partial view may end anywhere.
inline constexpr float kDenseOfPart = 6;
/// Reach, in spacings, within which the bits of a partial view must make the position certain.
inline constexpr float kDecidingOfPart = 32;
/// Maximum factor by which the reach grows from round to round. The plane fitted to the dots of one
/// round predicts the dots of the next round.
inline constexpr float kFarther = 3.5F;
/// Limits of clean bits, which need no second reading. The percentage of clear dots is at least
/// kClear_percent. Of n dots read, at most max(kMaxWrong, n / kDotsPerWrong) bits are wrong.
/// kMaxWrong is the number of bits of one dot.
inline constexpr int kClear_percent = 97;
inline constexpr int kMaxWrong = 2;
inline constexpr int kDotsPerWrong = 200;
/// Outlier limit: squared residual divided by the mean squared residual. The limit is four standard
/// deviations of one coordinate.
inline constexpr float kOutlier = 8.3F;
/// Maximum distance, in spacings, between the planes before and after a fit, in a corner of the
/// measured part. Above this distance, small centroid windows do not capture the full offsets, so
/// the dots are measured again.
inline constexpr float kFar = 0.055F;
/// Number of measurements of the dots after which an exact hypothesis counts as implausible if its
/// plane still changes by more than kFar. docs/accuracy.md, "Dots with the same sub-pixel phase",
/// lists the remaining errors.
inline constexpr int kMaxLooks = 3;
/// Fraction of the paper level below which windows are dropped. These windows are on the table
/// beyond the sheet, where noise can resemble dots.
inline constexpr float kTable = 0.4F;
/// Range of spacings for direct sampling. Below kMaxSpacingForSmallWindow_px, a dot fits in a small
/// centroid window at any blur. Below kMinSpacingForDirectSampling_px, one sample per place cannot
/// separate the four places of a cell.
inline constexpr float kMaxSpacingForSmallWindow_px = 13;
inline constexpr float kMinSpacingForDirectSampling_px = 8;
/// Radius of a centroid window, in dot radii. At this size, the window includes the edge of the
/// dot, and the result is nearly independent of the sub-pixel phase (`dotpose_tables alike`).
inline constexpr float kWindowRadii = 2.4F;
/// Minimum radius of a centroid window.
inline constexpr float kMinWindowRadius_px = 3.3F;
/// Radius of a centroid window above which facing dots bias each other, as a fraction of the
/// distance between these dots.
inline constexpr float kFacing = 0.55F;
/// Maximum deviation of a grid step from a whole number of pixels at which the dots of a row or
/// column have about the same sub-pixel phase. At a larger deviation, the phases of the dots in
/// view are evenly distributed.
inline constexpr float kDrift_px = 0.05F;
/// Maximum drift of the sub-pixel phase across the view, in px, at which the pixel bias is
/// corrected. The correction takes several times as long as the rest of the frame.
inline constexpr float kDriftInView_px = 0.35F;
/// Maximum variance of the mean of all centres, along one axis, at which the pixel bias matters.
inline constexpr float kMaxVariance_px2 = 0.01F * 0.01F;
/// Range of sizes of image parts that are prefetched. Smaller parts are already in the cache.
/// Larger parts would evict their own first rows.
inline constexpr int kMinFetched_bytes = 32 << 10;
inline constexpr int kMaxFetched_bytes = 1 << 20;
/// Minimum number of dots that `DotReader::find_centres` must find.
inline constexpr int kMinFound = 8;
/// Maximum distance of a predicted dot from its place, in px.
inline constexpr float kMaxOff_px = 1;
/// Maximum of sqrt(variance) / displacement + bit_errors / bits (`is_implausible`). A position with
/// a larger sum does not explain the frame well. For the numbers, see docs/integrity.md.
inline constexpr float kMaxImplausible = 0.57F;
/// Minimum residual at which a second attempt may be better: the larger of kRough_px and kRough
/// spacings. Residuals due to noise are constant in px. Residuals due to bad printing are constant
/// in spacings.
inline constexpr float kRough_px = 0.30F;
inline constexpr float kRough = 0.027F;
}  // namespace confirm

/// Constants of views of known sheets (locate/hypothesis, locate/workspace).
namespace known {
/// Shorter side of an image, in spacings, below which dots are read up to kMargin_px from the
/// border. Of 300 views of 36 x 36 px at 6 px per spacing, 88 % are located with the usual margin
/// of 1.7 px, and 97 % with a margin of 1.0 px. The errors are equal (`dotpose_tables known`).
inline constexpr float kSmallView = 9;
inline constexpr float kMargin_px = 1;
/// Minimum weight, in 1/127, of both bits of a cell that the second attempt reads.
inline constexpr int kMinWeight = 48;
}  // namespace known

/// Constants of frames that are read together (locate/earlier_bits). docs/integrity.md, "Frames
/// read together", explains them.
namespace joined {
/// log2 of the likelihood ratios of an equal and of a different bit in the overlap of two frames,
/// if one bit of 16 is wrong: log2(2 * 15 / 16) and log2(2 * 1 / 16).
inline constexpr float kEqualBit_log2 = 0.907F;
inline constexpr float kDifferentBit_log2 = -3;
/// log2 of the weight of the hypothesis that the measured motion is wrong by far more than its
/// standard deviation.
inline constexpr float kBlunder_log2 = -36;
/// Standard deviations of the errors of the grid of a frame: of its angle, which also depends on
/// the tilt of the camera, and of its place, in spacings.
inline constexpr float kGridAngle_rad = 0.035F;
inline constexpr float kGridPhase = 0.06F;
/// Maximum deviation of a match from the predicted match: in standard deviations, and in spacings.
inline constexpr float kReach_sigmas = 8;
inline constexpr float kMaxReach = 24;
}  // namespace joined

/// Constants of the second attempt (locate/second).
namespace second {
/// Factors applied to the thresholds for the filtered image. In this image, noise is a third of the
/// original noise, and dots are paler and wider. If dirt covers 5 % of the area (docs/limits.md,
/// 200 frames), 93 % of the frames are located with these factors, and 80 % with the original
/// thresholds.
inline constexpr int kLow_3rds = 2;
inline constexpr int kHigh_10ths = 9;
/// Divisor of the minimum contrast for a second detection in an image with too few dots. The
/// contrast can be reduced, because the noise of a filtered image is a third of the original noise.
/// The second detection finds dots that are 6 grey levels darker than paper (`dotpose_tables alike
/// --spacings 8 --dots 0.10 --blurs 1.5`).
inline constexpr int kPaleParts = 3;
/// Maximum turns of the periodogram search relative to the first estimate, in degrees, tried in
/// order. Printed text can rotate the first estimate by 26 degrees.
inline constexpr int kMaxTurns_deg[] = {12, 45};
}  // namespace second

/// Constants of the choice of attempts and codes (locate/locate, locate/other_place).
namespace cascade {
/// Minimum odds of another code, relative to the code of the fix, at which a frame is read again in
/// that code.
inline constexpr float kBetterOdds = 2;
/// Minimum number of dots per contradicting bit at which a reading in another code is reported.
/// With this limit, at most one bit in a hundred contradicts the reading, which can be due to
/// misread bits.
inline constexpr int kBitsPerError = 50;
/// Minimum odds of a different place in another code, relative to the fix, at which the place is
/// reported next to a certain fix.
inline constexpr float kNamedElsewhere = 0.99F;
/// Minimum odds of the same place in another code, relative to the fix, at which the place is
/// reported next to a certain fix.
inline constexpr float kNamedHere = 1024;
}  // namespace cascade

}  // namespace dotpose::core::tuning
