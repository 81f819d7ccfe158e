// Tuning: empirical constants of the attempts. Comments give the purpose and, where known, the
// measured effect of each constant. The constants of the second attempt were determined on the hard
// frames listed in decode/tuning.hpp.
#pragma once

#include "core/math/float_plane.hpp"

namespace dotpose::core::tuning {

/// Grids in patches (locate/first, locate/turning, locate/patch_hypothesis).
namespace patch_grid {
/// A grid is probably correct if the variance of the dot offsets along each axis is at most this
/// value, in spacings^2. The offset of a dot is relative to the nearest of the four dot positions
/// of its cell. In a false grid, the offsets are uniformly distributed over discs with a radius of
/// 0.18 spacings, so their variance is 0.008. If the fit of a false grid includes perspective, the
/// variance is smaller, but at least 0.0017 in the rolling-shutter frames tested. The variance of
/// the correct grid was less than 0.002 in all of 1,000 nominal frames, and less than 0.001 in 996
/// of them. In hard frames, the variance of correct grids can exceed 0.002, because the dots are
/// printed inaccurately. The limit was tested in 3,000 frames of scenes that rotate by 10 to 40
/// degrees during the readout. With a limit of 0.002, false grids end the search for a rotation too
/// early in 3 frames, or in 6 frames if the sheet is known. With a limit of 0.0015, this does not
/// happen in any frame.
inline constexpr float kMaxVariance = 0.0015F;
/// The search for the place is thorough only if the patch has at most this number of dots. With
/// more dots, enough lines are long enough to determine their rolls, so the brief search finds the
/// place. Of 1,000 frames of 188 x 120 px whose scene moves by 60 % of the image height during the
/// readout, 892 are located with a thorough search, and 845 without it.
inline constexpr int kMaxDotsForThoroughSearch = 144;
/// A place agrees with the bits if, on each axis, at most one bit in kMinBitsPerError is wrong.
inline constexpr int kMinBitsPerError = 16;
}  // namespace patch_grid

/// First attempt (locate/first).
namespace first {
/// Size of the smallest patches: 20 x 14 dots at 11 px per spacing. If no patch contains a readable
/// grid, the search continues with patches two and four times as wide and high.
inline constexpr int kPatchWidth_px = 224;
inline constexpr int kPatchHeight_px = 160;
/// Minimum spacing for direct sampling of dots at positions predicted from a patch. In finer grids,
/// direct sampling is less accurate than centroid windows.
inline constexpr float kMinSpacingForPrediction_px = 9.5F;
/// Assumed maximum ratio of the number of dots in the filtered image to the number of dots in the
/// original image.
inline constexpr float kDotsOfFilteredImage = 1.25F;
/// Maximum number of uncertain hypotheses that are tested away from the image centre. The number is
/// limited, because each uncertain hypothesis increases the probability of a wrong fix.
inline constexpr int kMaxTries = 4;
/// Parameters of the wave search away from the image centre: the numbers of central dots from which
/// the waves are computed, and the factors applied to the estimated spacing. The search tries all
/// combinations. Large displacements weaken the waves, and only some combinations find a grid with
/// weak waves.
inline constexpr float kCentralDots[] = {30, 20, 45, 25, 37};
inline constexpr float kSpacings[] = {1, 0.965F};
/// If the search for a skewed grid at the image centre finds no grid, or a grid that is probably
/// false, it is repeated with waves computed from this number of central dots.
inline constexpr float kFewerCentralDots = 20;
/// Factors applied to the estimated spacing if sheets are known. On a known sheet, a strip of only
/// three rows of dots can make the place certain. The estimated spacing of such a strip is too
/// large, because the estimate assumes that the nearest neighbours of a dot fill a disc. For the
/// same reason, the estimate is too large for dots among graphics.
inline constexpr float kSpacingsOfKnown[] = {1, 0.965F, 0.75F, 0.85F, 0.65F};
}  // namespace first

/// Search for a rotation of the scene during the readout (locate/turning).
namespace turning {
/// kMaxTurn_rad is the maximum rotation during the readout. kMaxFall is the maximum distance, in
/// rows, by which the rotation moves a point at the left or right image border downwards while one
/// row is read.
inline constexpr float kMaxTurn_rad = 1.2F;
inline constexpr float kMaxFall = 0.95F;
/// Maximum drift of the scene while a row is read, in rows.
inline constexpr float kMaxDrift = 0.9F;
/// kStep is the first step of the search for the rotation, expressed as the displacement of the
/// dots in the corners of the patch, in spacings. The search ends when the step has been reduced to
/// kStep / kStepParts.
inline constexpr float kStep = 0.4F;
inline constexpr float kStepParts = 32;
/// A grid replaces the best grid so far if its agreement exceeds this multiple of the best
/// agreement.
inline constexpr float kBetter = 1.0005F;
/// Minimum value of explained / (dots * variance) for a significant rotation. `explained` is the
/// part of the squared residuals that the rotation explains, summed over both axes. `variance` is
/// the remaining variance along one axis. kMinGainIfEven applies if the remaining residuals of
/// neighbouring dots are not correlated, and kMinGain otherwise. The values 0.5 and 3 correspond to
/// a fifth and to three fifths of all squared residuals.
inline constexpr float kMinGainIfEven = 0.5F;
inline constexpr float kMinGain = 3;
/// The rotation is not fitted if the quick estimate of the same value (`gain_of_turn`) is less than
/// kMinQuickGain.
inline constexpr float kMinQuickGain = 0.25F;
/// Maximum number of grids for which the search looks for a place in the code. If none of these
/// grids has a place, the search ends, because further rotations usually lead to the same grids.
inline constexpr int kMaxClimbs = 3;
/// If a correction of the rotation moves the dots in the image corners by at least kSettled_px, the
/// image is measured again. A smaller correction is applied to the dots already measured.
/// kMaxRounds is the maximum number of measurements.
inline constexpr float kSettled_px = 0.2F;
inline constexpr int kMaxRounds = 5;
/// In small views, the search for a rotation is skipped if the root mean square residual of the
/// first attempt, in spacings, is less than this value. It was 0.034 or more in frames of 64 to 96
/// px in which the search found a rotation (1.5 to 20 degrees), and at most 0.023 in still nominal
/// frames.
inline constexpr float kMinResidual = 0.028F;
/// The search for a rotation is skipped if `keep_isolated` keeps less than this fraction of the
/// dots. The first attempt then probably failed because of noise and dirt, not because of a
/// rotation. The fraction was at least 0.9 in 400 frames of rotating scenes, and less than 0.8 in
/// most hard frames.
inline constexpr float kMinIsolated = 0.88F;
}  // namespace turning

/// Tracked attempt (locate/tracked).
namespace tracked {
/// Half the side of the square whose dots are used for a correction, in spacings. The square is
/// centred on the point where the prediction is corrected. It is small enough that dots are
/// assigned to the correct intersections even if the predicted angle is wrong by a few degrees.
inline constexpr float kNear = 2.6F;
/// Minimum number of dots for a correction.
inline constexpr int kMinNear = 10;
/// Maximum prediction error that the search covers, in spacings. It is only slightly larger than
/// half a spacing, because at larger errors a neighbouring dot is closer than the correct dot.
inline constexpr float kMaxOff = 0.6F;
/// Range of spacings that can be tracked.
inline constexpr float kFinest_px = 5;
inline constexpr float kCoarsest_px = 80;
/// Range of plausible displacements in a prediction, in spacings.
inline constexpr float kMinDisplacement = 0.05F;
inline constexpr float kMaxDisplacement = 0.4F;
/// Maximum distance between a dot and its predicted position, in spacings: kFirstOff in the first
/// fit, and kSecondOff in the second.
inline constexpr float kFirstOff = 0.30F;
inline constexpr float kSecondOff = 0.15F;
/// Maximum offset of a dot that is measured in a centroid window. Dots with larger offsets are
/// dropped.
inline constexpr float kMaxOffset_px = 1.5F;
/// Factor that converts the ratio of moment to weight in a centroid window to the offset of the
/// dot, in px (see `find_centres`). For a typical dot, the resulting offset is accurate to within
/// 20 %.
inline constexpr float kWeight_px = 0.84F;
/// The dots are measured again if the scale and rotation of a correction move the dots at the image
/// border by at least this distance.
inline constexpr float kTurned_px = 2;
/// Maximum number of measurements in one correction.
inline constexpr int kMaxLooks = 3;
/// Points around which the search looks for dots, relative to the image centre, in fractions of the
/// image sides. The pattern may be covered at one point and visible at another.
inline constexpr FloatVec kPoints[] = {
    {0, 0}, {-0.25F, -0.22F}, {0.25F, 0.22F}, {0.25F, -0.22F}, {-0.25F, 0.22F}};
}  // namespace tracked

/// Measurement of dots at predicted positions (locate/confirm, locate/dot_reader).
namespace confirm {
/// Reading distance in the first round, in spacings. The first round measures all dots within this
/// distance of `Hypothesis::from_centre`, and the bits of these dots must make the position
/// certain. Partial views and small images (see kDenseAtMost) use other distances.
inline constexpr float kDense = 10;
/// If half of the longer image side is at most this number of spacings, the whole image is measured
/// in a single round.
inline constexpr float kDenseAtMost = 17;
/// Reading distance in the first round of a partial view, in spacings. The distance is small
/// because the pattern may end anywhere.
inline constexpr float kDenseOfPart = 6;
/// Distance within which the bits of a partial view must make the position certain, in spacings.
inline constexpr float kDecidingOfPart = 32;
/// Maximum growth factor of the reading distance from round to round. The factor is limited,
/// because the plane fitted in one round must predict the dots of the next round.
inline constexpr float kFarther = 3.5F;
/// Limits for clean bits. If the bits are clean, the dots are not read a second time. At least
/// kClear_percent % of the dots seen must be read. If n dots were read, at most max(kMaxWrong, n /
/// kDotsPerWrong) bits may be wrong. kMaxWrong is 2 because one misread dot can have two wrong
/// bits.
inline constexpr int kClear_percent = 97;
inline constexpr int kMaxWrong = 2;
inline constexpr int kDotsPerWrong = 200;
/// A dot is an outlier if its squared residual exceeds kOutlier times the mean squared residual of
/// all dots. The squared residual of a dot is summed over both coordinates, so the limit is about
/// four standard deviations of one coordinate.
inline constexpr float kOutlier = 8.3F;
/// Maximum distance by which a fit may move a corner of the measured area, in spacings along an
/// axis. If the distance is larger, the dots are measured again, because small centroid windows do
/// not measure large offsets accurately.
inline constexpr float kFar = 0.055F;
/// If this number of fits move the plane of an exact hypothesis by more than kFar, the hypothesis
/// is implausible. docs/accuracy.md, "Dots with the same sub-pixel phase", lists the errors that
/// remain.
inline constexpr int kMaxLooks = 3;
/// Windows are dropped if their paper level is less than kTable times the mean paper level. Such
/// windows are on the table beyond the sheet, where noise can look like dots.
inline constexpr float kTable = 0.4F;
/// Range of spacings for direct sampling. Below kMaxSpacingForSmallWindow_px, a dot with any blur
/// fits in a small centroid window. Below kMinSpacingForDirectSampling_px, one sample per position
/// cannot distinguish the four possible dot positions of a cell.
inline constexpr float kMaxSpacingForSmallWindow_px = 13;
inline constexpr float kMinSpacingForDirectSampling_px = 8;
/// If the shorter side of a cell is below this limit, in spacings, the windows around intersections
/// are made smaller (`window_reach`). A tilt of 30 degrees shortens this side to 0.93 spacings. If
/// a scene moves by 60 % of the image height during the readout, the side is 0.6 to 0.9 spacings.
/// With windows of the usual size, 883 of 1,000 such frames of 188 x 120 px are located. A limit of
/// 0.7 increases this number to 888, and a limit of 0.75 or 0.8 to 892.
inline constexpr float kMinSideOfSquare = 0.75F;
/// Radius of a centroid window, in dot radii. With this radius, the window includes the edge of the
/// dot, and the result is nearly independent of the sub-pixel phase (`dotpose_tables alike`).
inline constexpr float kWindowRadii = 2.4F;
/// Minimum radius of a centroid window.
inline constexpr float kMinWindowRadius_px = 3.3F;
/// If the window radius exceeds this fraction of the distance between two facing dots, the dots
/// bias each other's centroids. Facing dots are adjacent dots that are displaced towards each
/// other. See pose/facing_dots.hpp.
inline constexpr float kFacing = 0.55F;
/// If the step between cells deviates from an integer number of pixels by less than this distance,
/// the dots of a row or column have about the same sub-pixel phase. At larger deviations, the
/// phases in view are uniformly distributed.
inline constexpr float kDrift_px = 0.05F;
/// The pixel bias is corrected only if the sub-pixel phases of the dots of a row or column change
/// by less than this distance across the view. This limit keeps corrections rare, because a
/// correction takes several times as long as all other steps combined.
inline constexpr float kDriftInView_px = 0.35F;
/// The pixel bias is not significant if the variance of the mean dot centre along one axis exceeds
/// this limit, because other errors are then larger than the bias.
inline constexpr float kMaxVariance_px2 = 0.01F * 0.01F;
/// Minimum and maximum size of image areas that are prefetched. Smaller areas are already in the
/// cache. Larger areas would evict their own first rows.
inline constexpr int kMinFetched_bytes = 32 << 10;
inline constexpr int kMaxFetched_bytes = 1 << 20;
/// If the image contains fewer than this number of cells, bits are also read from dots that are cut
/// off by the image border. With more cells, the position is certain without these dots.
inline constexpr float kMaxCellsWithCutDots = 144;
/// Maximum number of pixels of a small image (see `is_small`). Images with more pixels rarely
/// contain fewer than kMaxCellsWithCutDots cells unless a rolling shutter stretches the cells, and
/// filtering often reveals many more dots in them.
inline constexpr int kMaxPixelsOfSmallImage = 96 * 96;
/// Minimum number of cells in a small view for which a second attempt is made. Of 241 frames of 72
/// x 72 px in which a grid of 64 cells was found, a second attempt located none. docs/speed.md,
/// "Small frames", contains the numbers for other sizes.
inline constexpr float kMinCellsForSecond = 70;
/// Maximum distance of a listed intersection beyond the image border, in spacings. The dot of such
/// an intersection may still be partly visible.
inline constexpr float kBeyondBorder = 0.2F;
/// Minimum number of dots that `DotReader::find_centres` must find to fit a plane to them.
inline constexpr int kMinFound = 8;
/// Maximum offset of a directly sampled dot from its predicted position. Dots with larger offsets
/// are dropped.
inline constexpr float kMaxOff_px = 1;
/// If sqrt(variance) / displacement + bit_errors / bits exceeds this limit, the position does not
/// explain the frame well (see `is_implausible`). docs/integrity.md contains the measurements.
inline constexpr float kMaxImplausible = 0.57F;
/// Limits of `shows_overlay`. Let r be the fraction of the dots seen that were read without a wrong
/// bit. A fix is rejected if r is below kMinRight and more than kMaxWrongInOverlay of the bits read
/// are wrong. Of 1,800 fixes in frames with seams, cuts, blank areas and wrong bits, two had an r
/// below kMinRight but no wrong bits, and two others had an r of 0.40 to 0.51. Two wrong fixes in
/// the test `Adversarial.ColumnsAndRowsAreOfOnePattern` had r = 0.27 with 3.6 % wrong bits, and r =
/// 0.25 with 1.6 % wrong bits.
inline constexpr float kMinRight = 0.375F;
inline constexpr float kMaxWrongInOverlay = 0.005F;
/// A second attempt may give a better fix if the residual is at least kRough_px and at least kRough
/// spacings. Two limits are needed, because residuals due to noise are constant in px, and
/// residuals due to bad printing are constant in spacings.
inline constexpr float kRough_px = 0.30F;
inline constexpr float kRough = 0.027F;
}  // namespace confirm

/// Views of known sheets (locate/hypothesis, locate/on_sheets).
namespace known {
/// If the shorter image side is less than kSmallView spacings, the margin at the image border is
/// reduced to kMargin_px. Dots in the margin are not read. The usual margin is at least 1.7 px. Of
/// 300 views of 36 x 36 px at 6 px per spacing, 97 % are located with a margin of 1.0 px, and 88 %
/// with the usual margin. The pose errors are equal in both cases (`dotpose_tables known`).
inline constexpr float kSmallView = 9;
inline constexpr float kMargin_px = 1;
/// Minimum weight of a bit, in units of 1/127. The second attempt uses a cell only if each of its
/// two bits has at least this weight.
inline constexpr int kMinWeight = 48;
}  // namespace known

/// Frames that are read together (locate/earlier_bits). See docs/integrity.md, "Frames read
/// together".
namespace joined {
/// log2 of the likelihood ratio for a bit that is equal in two overlapping frames, and for a bit
/// that differs. The values are log2(2 * 15 / 16) and log2(2 * 1 / 16), for an error rate of 1 bit
/// in 16.
inline constexpr float kEqualBit_log2 = 0.907F;
inline constexpr float kDifferentBit_log2 = -3;
/// log2 of the weight of a blunder: a measured motion whose error is far larger than its standard
/// deviation.
inline constexpr float kBlunder_log2 = -36;
/// Standard deviations of the angle error of the grid, in rad, and of its position error, in
/// spacings. The angle error includes the effect of the camera tilt.
inline constexpr float kGridAngle_rad = 0.035F;
inline constexpr float kGridPhase = 0.06F;
/// Maximum deviation of a match from the prediction: kReach_sigmas standard deviations, but at most
/// kMaxReach spacings.
inline constexpr float kReach_sigmas = 8;
inline constexpr float kMaxReach = 24;
}  // namespace joined

/// Second attempt (locate/second).
namespace second {
/// Factors for the thresholds in a filtered image: the low threshold is multiplied by kLow_3rds /
/// 3, and the high threshold by kHigh_10ths / 10. Filtering reduces noise to a third, and makes
/// dots paler and wider. With dirt on 5 % of the area, 93 % of 200 frames are located with these
/// factors, and 80 % with the original thresholds (docs/limits.md).
inline constexpr int kLow_3rds = 2;
inline constexpr int kHigh_10ths = 9;
/// If an image has too few dots, dots are detected again with the minimum contrast divided by this
/// number. The contrast can be lower because filtering reduces noise to a third. The second
/// detection finds dots that are 6 grey levels darker than the paper (`dotpose_tables alike
/// --spacings 8 --dots 0.10 --blurs 1.5`).
inline constexpr int kPaleParts = 3;
/// Maximum rotations that the periodogram search tries, relative to the first grid estimate, in
/// degrees. If the search finds no grid up to the first maximum, it is repeated with the second,
/// because printed text can cause an error of 26 degrees in the first estimate.
inline constexpr int kMaxTurns_deg[] = {12, 45};
}  // namespace second

/// Choice of attempts and codes (locate/locate, locate/other_place).
namespace cascade {
/// The frame is read again in another code if the odds of that code, relative to the code of the
/// fix, exceed this number.
inline constexpr float kBetterOdds = 2;
/// Minimum number of dots per wrong bit for a place in another code to be reported. A dot has two
/// bits, so the maximum error rate is 1 %. Misread bits can cause this error rate even if the place
/// is correct.
inline constexpr int kMinDotsPerBitError = 50;
/// A different place in another code is also reported if its likelihood is at least this fraction
/// of the likelihood of the fix.
inline constexpr float kNamedElsewhere = 0.99F;
/// The place of the fix is also reported in another code if its likelihood in that code exceeds
/// this multiple of the likelihood of the fix.
inline constexpr float kNamedHere = 1024;
}  // namespace cascade

}  // namespace dotpose::core::tuning
