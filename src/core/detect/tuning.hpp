// Tuning: empirical constants for dot detection. The constants for the second attempt were
// determined on the hard frames listed in decode/tuning.hpp. Some comments state how many frames
// are located with other values of a constant, as printed by the command
//
//     dotpose evaluate --preset hard --frames 2000 --seed 404
//
// With the values in this file, 1,994 of the 2,000 frames are located.
#pragma once

namespace dotpose::core::tuning {

/// Paper levels of image blocks (detect/paper).
namespace paper {
/// Ratio of the shorter image side to the side of a block. A block contains enough paper if at
/// least 8 dots are in view along the shorter image side. Larger blocks would not follow light
/// gradients.
inline constexpr int kBlockPart = 10;
/// Number of pixels sampled along each block side.
inline constexpr int kSamplesPerSide = 12;
/// Maximum fraction of a block's pixels that are darker than its paper level, in thirds. The paper
/// level is the highest level that satisfies this limit. Dots cover a much smaller fraction.
inline constexpr int kDarker_3rds = 2;
/// Minimum level of a block, in quarters of the level of its brightest neighbour. A darker block is
/// assumed to be under graphics, and its level is replaced with the level of the neighbour. Light
/// gradients cause smaller differences between neighbouring blocks.
inline constexpr int kCovered_4ths = 3;
}  // namespace paper

/// Light normalisation in the second attempt (detect/smooth).
namespace smooth {
/// Minimum half-width of the averaging window, in px. This is about half the width of a dot. The
/// window shrinks to this size at the image border.
inline constexpr int kMinHalf_px = 4;
/// Level below which a pixel is assumed to be part of text or graphics, in tenths of the brightest
/// paper level nearby. Such pixels are replaced with the paper level when the local mean is
/// computed, because this mean must depend only on the illumination. With a value of 4 or 9, 1,995
/// frames are located.
inline constexpr int kStroke_10ths = 7;
/// Minimum level of the normalised image, in fifths of kNormalLevel. Graphics are clamped to this
/// level, so they are no darker than a pale dot. Otherwise, the required contrast near dark
/// graphics would exceed the contrast of dots. With a value of 2, only 1,937 frames are located.
inline constexpr int kMinLevel_5ths = 4;
}  // namespace smooth

/// Dot detection in a patch (detect/patch).
namespace patch {
/// A patch is small if its shorter side is below this limit, in patch pixels.
inline constexpr int kSmall_px = 48;
/// A tile has contrast if its darkest smoothed pixel is at least kMinDarkness grey levels darker
/// than the paper. At least kMinTiles tiles of a patch must have contrast. For a small patch, the
/// minimum is half of its tiles.
inline constexpr int kMinDarkness = 12;
inline constexpr int kMinTiles = 12;
/// Parameters of `DotTiles::pale`. The dot contrast is the 1/kPaleParts quantile of the darkness of
/// the tiles with contrast. If it exceeds kMaxPale times the median darkness, the patch contains no
/// pale tiles, and `measure_contrast` returns false.
inline constexpr int kPaleParts = 6;
inline constexpr float kMaxPale = 0.75F;
/// Minimum darkness of a dot, in units of 1/256 of the darkness of a typical dot. Lighter minima
/// are treated as noise.
inline constexpr int kThreshold_q8 = 150;
/// Offsets of the eight points that are tested around a minimum, in patch pixels: kAway_px along
/// one axis, or kDiagonally_px along both axes. At most kMaxDark of these points may be dark. The
/// limit is not 0, because some of the points may be on neighbouring dots.
inline constexpr int kAway_px = 4;
inline constexpr int kDiagonally_px = 3;
inline constexpr int kMaxDark = 2;
}  // namespace patch

}  // namespace dotpose::core::tuning
