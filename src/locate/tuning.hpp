// Tuning: the numbers of the attempts that were found by trying rather than derived, with what each
// protects and, where known, what measured it. Those of the second attempt were found on the hard
// frames that decode/tuning.hpp names.
#pragma once

#include "core/math/float_plane.hpp"

namespace dotpose::core::tuning {

/// Numbers of the first attempt (locate/first).
namespace first {
/// Size of the part of the image that is searched first, and of the parts elsewhere: 20 x 14 dots
/// that are 11 px apart.
inline constexpr int kPatchWidth_px = 224;
inline constexpr int kPatchHeight_px = 160;
/// Finest grid whose dots are measured in one look: those of finer ones are measured more
/// accurately by bells of their own size.
inline constexpr float kFinestOneLook_px = 9.5F;
/// Number of hypotheses elsewhere whose bits may contradict them: each is one more chance of a
/// wrong fix.
inline constexpr int kMostTries = 4;
/// For patches elsewhere: numbers of dots near the middle whose waves are searched, and factors on
/// the spacing. Where dots are displaced so far that their waves are faint, some discs show the
/// grid and others do not.
inline constexpr float kCentralDots[] = {30, 20, 45, 25, 37};
inline constexpr float kSpacings[] = {1, 0.965F};
}  // namespace first

/// Numbers of the tracked attempt (locate/tracked).
namespace tracked {
/// Reach, in spacings, of the dots near one point that show the error of the prediction, and their
/// least number: so near that a turn does not confuse them.
inline constexpr float kNear = 2.6F;
inline constexpr int kFewestNear = 10;
/// Greatest error of a prediction, in spacings: beyond half of one, the next dot is nearer.
inline constexpr float kMostOff = 0.6F;
/// Range of the spacings that can be tracked.
inline constexpr float kFinest_px = 5;
inline constexpr float kCoarsest_px = 80;
/// Range of the displacements that are plausible in a prediction, in spacings.
inline constexpr float kLeastDisplacement = 0.05F;
inline constexpr float kMostDisplacement = 0.4F;
/// Greatest distance of a dot from its place in the first and in the second fit, in spacings.
inline constexpr float kFirstOff = 0.30F;
inline constexpr float kSecondOff = 0.15F;
/// Bells: how far dots may be off to be seen by them; the distance at which the moment of a usual
/// dot equals its weight, which is right to a fifth; how far a correction may move the border of
/// the image before another look is needed; and the most looks.
inline constexpr float kSeenByBells_px = 1.5F;
inline constexpr float kWeight_px = 0.84F;
inline constexpr float kTurned_px = 2;
inline constexpr int kMostLooks = 3;
/// Points around which dots are searched, from the image centre, in shares of the image's sides:
/// where one is covered, another may not be.
inline constexpr FloatVec kPoints[] = {
    {0, 0}, {-0.25F, -0.22F}, {0.25F, 0.22F}, {0.25F, -0.22F}, {-0.25F, 0.22F}};
}  // namespace tracked

/// Numbers for measuring dots at known places (locate/confirm, locate/dot_reader).
namespace confirm {
/// Distance from the image centre, in spacings, within which all dots are measured and must make
/// the position certain.
inline constexpr float kDense = 10;
/// An image that reaches no farther than this, in spacings, is measured completely at once.
inline constexpr float kDenseAtMost = 17;
/// Where the pattern may end anywhere: distances, in spacings, of the dots measured first and of
/// those whose bits decide whether the place is certain.
inline constexpr float kDenseOfPart = 6;
inline constexpr float kDecidingOfPart = 32;
/// Factor by which a plane can be trusted beyond the dots that it was fitted to.
inline constexpr float kFarther = 3.5F;
/// Bits are clean, and need no second reading, if at least this share of the dots is clear and at
/// most this number of bits is wrong, those of one dot, or of many, one for so many dots.
inline constexpr int kClear_percent = 97;
inline constexpr int kMostWrong = 2;
inline constexpr int kDotsPerWrong = 200;
/// Greatest square of a dot's residual that counts, over the mean of the squares: four standard
/// deviations.
inline constexpr float kOutlier = 8.3F;
/// Distance in spacings, in a corner of what is in reach, between the planes before and after a
/// fit, from which quick bells miss a part of a dot's distance, so that another look is made; and
/// the most looks. docs/accuracy.md, "Dots that fall on the pixels alike", shows the remaining
/// errors.
inline constexpr float kFar = 0.055F;
inline constexpr int kMostLooks = 3;
/// Windows darker than this share of the paper's level show the table beyond the sheet, where noise
/// is as dark as dots.
inline constexpr float kTable = 0.4F;
/// Range of spacings for one look at each dot. Below kQuickBells_px dots are so small that quick
/// bells are wide enough, however blurred they are; below kFinestOnePass_px the four places of a
/// cell are too near to each other to be told apart in one look.
inline constexpr float kQuickBells_px = 13;
inline constexpr float kFinestOnePass_px = 8;
/// Reach of a bell, in radii of a dot and at least in px: as far as the edge of a dot is seen, and
/// so far that it does not depend on how dots fall on the pixels (`dotpose_tables alike`).
inline constexpr float kBellRadii = 2.4F;
inline constexpr float kLeastBell_px = 3.3F;
/// Share of the distance between facing dots that a bell must reach for them to draw each other's
/// centres.
inline constexpr float kFacing = 0.55F;
/// Steps of the grid that differ from whole pixels by less than this make all dots fall on the
/// pixels alike; with more, the dots of a view drift through all of a pixel.
inline constexpr float kDrift_px = 0.05F;
/// Drift across the view up to which dots fall on the pixels so much alike that their bias is worth
/// computing, which takes several times as long as the rest of the frame.
inline constexpr float kDriftInView_px = 0.35F;
/// Greatest variance, along an axis, of the place of all dots together beside which biases count.
inline constexpr float kMostVariance_px2 = 0.01F * 0.01F;
/// Range of the parts of images whose pixels are asked for before they are needed: smaller ones are
/// in the cache already, and larger ones would push out their own first rows.
inline constexpr int kFewestFetched_bytes = 32 << 10;
inline constexpr int kMostFetched_bytes = 1 << 20;
/// Fewest predicted dots that are enough to go on.
inline constexpr int kFewestFound = 8;
/// Greatest distance of a predicted dot from its place, in px.
inline constexpr float kMostOff_px = 1;
/// Greatest sum of the dots' scatter, relative to their displacement, and the share of
/// contradicting bits; beyond it the position explains the frame badly. docs/integrity.md has the
/// numbers.
inline constexpr float kMostImplausible = 0.57F;
/// Residuals from which a second attempt may be better: in px for dots moved by noise, in spacings
/// for dots that were printed badly.
inline constexpr float kRough_px = 0.30F;
inline constexpr float kRough = 0.027F;
}  // namespace confirm

/// Numbers of the second attempt (locate/second).
namespace second {
/// Factors on the thresholds for the filtered image, in which noise is a third and dots are paler
/// and wider. Frames with dirt over 5 % of the area (docs/limits.md, 200 frames) were located in 93
/// % with these, and in 80 % with the thresholds of the options.
inline constexpr int kLow_3rds = 2;
inline constexpr int kHigh_10ths = 9;
/// Part (1/n) of the least contrast with which an image is looked at again that shows too few dots:
/// noise is a third in a filtered image. Dots 6 grey levels darker than paper are found by it
/// (`dotpose_tables alike --spacings 8 --dots 0.10 --blurs 1.5`).
inline constexpr int kPaleParts = 3;
/// Maximum turns of the periodogram search from the first estimate, in degrees, one try after the
/// other. Words can turn the first estimate by 26 degrees.
inline constexpr int kMaxTurns_deg[] = {12, 45};
}  // namespace second

/// Numbers of the choice of attempts and codes (locate/locate, locate/other_place).
namespace cascade {
/// Odds from which a frame is read again in the code that explains it better.
inline constexpr float kBetterOdds = 2;
/// Least number of bits for each contradicting one from which a reading in another code is
/// reported: apart from misread bits, less than one in a hundred contradicts.
inline constexpr int kBitsPerError = 50;
/// Odds of a place in another code from which it is reported beside a certain fix, elsewhere and at
/// the same place.
inline constexpr float kNamedElsewhere = 0.99F;
inline constexpr float kNamedHere = 1024;
}  // namespace cascade

}  // namespace dotpose::core::tuning
