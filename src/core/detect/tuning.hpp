// Tuning: empirical constants of dot detection. The constants of the second attempt were determined
// on the hard frames listed in decode/tuning.hpp. Comments state the number of frames that `dotpose
// evaluate --preset hard --frames 2000 --seed 404` locates with other values. With the values in
// this file, the command locates 1,994 of 2,000 frames.
#pragma once

namespace dotpose::core::tuning {

/// Measurement of the paper level in blocks of the image (detect/paper).
namespace paper {
/// Side of a block, as a fraction 1/n of the shorter side of the image. A block contains enough
/// paper even if only 8 dots are in view along this side, but is small enough to follow light
/// gradients.
inline constexpr int kBlockPart = 10;
/// Number of pixels sampled along each side of a block.
inline constexpr int kSamplesPerSide = 12;
/// Fraction of the pixels of a block, in thirds, that are darker than its paper level. Dots cover a
/// much smaller fraction of a block, so a pixel of this level is paper.
inline constexpr int kDarker_3rds = 2;
/// Minimum level of a block, in fourths of the level of the brightest block around it. A darker
/// block counts as covered by graphics, because light gradients cause smaller differences between
/// neighbouring blocks. The brightest level replaces the level of a covered block.
inline constexpr int kCovered_4ths = 3;
}  // namespace paper

/// Normalisation of the light in the second attempt (detect/smooth).
namespace smooth {
/// Minimum half side of the window over which the light level is averaged, in px: about half the
/// width of a dot. The window shrinks to this size at the border of the image.
inline constexpr int kMinHalf_px = 4;
/// Maximum level of a stroke, in tenths of the brightest paper level nearby. Pixels below this
/// level count as paper in the mean of the surroundings, because a stroke of graphics is not a
/// shadow. The value is not critical: with 4 or with 9, the command locates 1,995 frames.
inline constexpr int kStroke_10ths = 7;
/// Minimum level of the normalised image, in fifths of kNormalLevel. This limit makes graphics at
/// most as dark as a weak dot. Near darker graphics, the required contrast would exceed the
/// contrast of dots. With 2, the command locates only 1,937 frames.
inline constexpr int kMinLevel_5ths = 4;
}  // namespace smooth

/// Detection of dots in a patch of the image (detect/patch).
namespace patch {
/// Minimum length of the shorter side, in px, of a patch to which `kMinTiles` applies. Smaller
/// patches have too few tiles.
inline constexpr int kSmall_px = 48;
/// Minimum darkness, in grey levels below the paper level, of the darkest smoothed pixel of a tile.
/// Tiles with less darkness count as blank. At least kMinTiles tiles of a patch, or half of the
/// tiles of a small patch, must not be blank.
inline constexpr int kMinDarkness = 12;
inline constexpr int kMinTiles = 12;
/// Minimum darkness of a dot, in units of 1/256 of the darkness of a typical dot. Lighter minima of
/// the smoothed patch count as noise.
inline constexpr int kThreshold_q8 = 150;
/// Distances in px, along the axes and diagonally, at which the surroundings of a minimum are
/// tested. At most kMaxDark of the eight directions may be dark, for example because of a
/// neighbouring dot.
inline constexpr int kAway_px = 4;
inline constexpr int kDiagonally_px = 3;
inline constexpr int kMaxDark = 2;
}  // namespace patch

}  // namespace dotpose::core::tuning
