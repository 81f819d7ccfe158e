// Tuning: the numbers of the attempts that were found by trying rather than derived. Those of the
// second attempt were found on the hard frames that decode/tuning.hpp names. A comment says what
// each protects, and what measured it where that is known.
#pragma once

#include "core/math/float_plane.hpp"

namespace dotpose::core::tuning {

/// The first attempt (attempts/first).
namespace first {
/// The part of the image that is looked at first, and the sides of the ones elsewhere: 20 x 14
/// dots, 11 px apart.
inline constexpr int kPatchWidth_px = 224;
inline constexpr int kPatchHeight_px = 160;
/// Looks elsewhere that the bits may fail to bear out: each is one more chance to be deceived.
inline constexpr int kMostTries = 4;
/// Dots near the middle whose waves are looked at, elsewhere: where dots are displaced so far that
/// their waves are faint, some discs show others; and by how much the spacing may be smaller.
inline constexpr float kCentralDots[] = {30, 20, 45, 25, 37};
inline constexpr float kSpacings[] = {1, 0.965F};
}  // namespace first

/// The tracked attempt (attempts/tracked).
namespace tracked {
/// Dots so near one point of the image, in spacings, tell how far the prediction is off: few enough
/// for a turn not to mix them up, and at least so many of them.
inline constexpr float kNear = 2.6F;
inline constexpr int kFewestNear = 10;
/// The most that a prediction may be off, in spacings: beyond half of one, the next dot is nearer.
inline constexpr float kMostOff = 0.6F;
/// Spacings of planes that can be tracked.
inline constexpr float kFinest_px = 5;
inline constexpr float kCoarsest_px = 80;
/// Displacements that are believed of a prediction, spacings.
inline constexpr float kLeastDisplacement = 0.05F;
inline constexpr float kMostDisplacement = 0.4F;
/// Spacings that a dot may be off in the first fit, and in the second.
inline constexpr float kFirstOff = 0.30F;
inline constexpr float kSecondOff = 0.15F;
/// Where dots are looked for first, from the image centre, in shares of the image's sides: where
/// one place is covered, another may not be.
inline constexpr FloatVec kPoints[] = {
    {0, 0}, {-0.25F, -0.22F}, {0.25F, 0.22F}, {0.25F, -0.22F}, {-0.25F, 0.22F}};
}  // namespace tracked

/// Measuring where the code has dots (attempts/confirm, attempts/dot_reader).
namespace confirm {
/// Around the image centre, so many spacings, all dots are measured, and must make the position
/// certain.
inline constexpr float kDense = 10;
/// Where the image ends within so many, it is measured at once.
inline constexpr float kDenseAtMost = 17;
/// Where the pattern may end anywhere, the first look reaches this far, in spacings, and the bits
/// that decide whether the place is certain reach that far.
inline constexpr float kDenseOfPart = 6;
inline constexpr float kDecidingOfPart = 32;
/// How much farther a plane can be trusted than the dots reach that it was fitted to.
inline constexpr float kFarther = 3.5F;
/// Bits are clean where so many percent of the dots are clear and hardly a bit is wrong: they need
/// no second reading.
inline constexpr int kClear_percent = 97;
inline constexpr int kMostWrong = 1;
/// Squares of what dots are off that count, over their mean: four deviations.
inline constexpr float kOutlier = 8.3F;
/// Px between the plane before and after a fit, in a corner, from which quick bells do not see all
/// of a dot's distance: a second look is made. docs/accuracy.md, "Dots that fall on the pixels
/// alike", shows what these looks leave.
inline constexpr float kFar_px = 0.055F;
/// Windows so much darker than the paper, as a share of its level, show the table beyond the sheet,
/// where noise is as dark as dots.
inline constexpr float kTable = 0.4F;
/// Up to such spacings dots are so small that quick bells are wide enough, however they are
/// blurred; of grids finer than the other, the places of a cell are too near to each other to be
/// told apart at a look.
inline constexpr float kQuickBells_px = 13;
inline constexpr float kFinestOnePass_px = 8;
/// Reach of a bell in radii of a dot, and px at least: as far as a dot's edge is seen, and not so
/// little that it would depend on how dots fall on the pixels (`dotpose_alike`).
inline constexpr float kBellRadii = 2.4F;
inline constexpr float kLeastBell_px = 3.3F;
/// Steps of the grid that are whole pixels but for so much make all dots fall on the pixels alike:
/// with more, a view's dots drift through all of a pixel.
inline constexpr float kDrift_px = 0.05F;
/// Dots that tell how large a typical one is.
inline constexpr float kSomeDots = 30;
/// Px that a predicted dot may be off.
inline constexpr float kMostOff_px = 1;
/// Scatter of the dots relative to their displacement, and the share of bits that contradict,
/// together: beyond, the position explains badly what is seen. docs/integrity.md has the numbers.
inline constexpr float kMostImplausible = 0.57F;
}  // namespace confirm

/// The attempt by rows (attempts/steps, attempts/rows).
namespace rows {
/// Dots that the grid is looked for with: their number is time on devices (docs/firmware.md).
inline constexpr int kSeeds = 64;
/// The grid is looked for in the middle of the dots where that is farther from the image centre
/// than this part of half a side: a pattern that fills the view has it within a few hundredths.
inline constexpr int kFarPart = 4;
/// Residuals from which a second attempt is worth while: px for dots that noise has moved, spacings
/// for those that were printed badly.
inline constexpr float kRough_px = 0.30F;
inline constexpr float kRough = 0.027F;
}  // namespace rows

/// The second attempt (attempts/second).
namespace second {
/// Thresholds of the filtered image against those of the options: noise is a third of what it was,
/// and dots are paler and wider. Frames with dirt over 5 % of the area (docs/limits.md, 200 frames)
/// were located in 93 % with these, and in 80 % with the options' own.
inline constexpr int kLow_3rds = 2;
inline constexpr int kHigh_10ths = 9;
/// Degrees that the periodogram may be turned against the first estimate, try by try: between
/// graphics, the connections of what is left of the dots may point anywhere.
inline constexpr int kMostTurns_deg[] = {12, 45};
/// Whether a further look presumes the axis that is beyond doubt, look by look; after the last one
/// the frame is refused.
inline constexpr bool kResamplesPresume[] = {true, false, true};
}  // namespace second

/// Any code (attempts/any_code, attempts/other_place).
namespace any_code {
/// Odds of other places below which they are doubts like others, which a closer look may dispel.
inline constexpr float kAsWell = 1e-3F;
/// From these odds on a frame is read again in the profile that explains it better.
inline constexpr float kBetter = 2;
/// Odds of profiles in which no attempt is made: other frames speak against them.
inline constexpr float kRuledOut = 1e-9F;
/// Sums are rounded up by more than that.
inline constexpr float kRoundings = 1.01F;
/// Bits for each one that contradicts, from which on a reading in another profile is named: but for
/// bits misread, less than one in a hundred.
inline constexpr int kBitsPerError = 50;
/// Odds of a place in another profile from which it is named beside a certain fix, elsewhere and at
/// the same place.
inline constexpr float kNamedElsewhere = 0.99F;
inline constexpr float kNamedHere = 1024;
}  // namespace any_code

}  // namespace dotpose::core::tuning
