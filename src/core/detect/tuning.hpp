// Tuning: the numbers of dot detection that were found by trying rather than derived. Those of the
// second attempt were found on the hard frames that decode/tuning.hpp names; where a line compares
// values, it gives the frames located by `dotpose evaluate --preset hard --frames 2000 --seed 404`:
// 1,994 with the values as they are.
#pragma once

namespace dotpose::core::tuning {

/// Numbers of the paper's grey level by blocks (detect/paper).
namespace paper {
/// Side of a block, as a part (1/n) of the image's shorter side: some spacings even where few dots
/// are in view, and still small against the shading of lamps and lenses.
inline constexpr int kBlockPart = 10;
/// Number of pixels sampled along each side of a block.
inline constexpr int kSamplesPerSide = 12;
/// Share of a block's pixels, in thirds, that are darker than its paper level: dots cover less, and
/// noise lies above and below.
inline constexpr int kDarker_3rds = 2;
/// A block darker than this share, in fourths, of the brightest around it is covered by graphics
/// and gets that level instead: light changes less from block to block.
inline constexpr int kCovered_4ths = 3;
}  // namespace paper

/// Numbers for evening out light in the second attempt (detect/smooth).
namespace smooth {
/// Half the side of the surroundings at the image's border, in px: they shrink there, but not below
/// the width of a dot.
inline constexpr int kSmallestHalf_px = 4;
/// A pixel darker than this share, in tenths, of the brightest paper near it counts as paper in the
/// mean of the surroundings: strokes of graphics are not shadow. With 4: 1,995; with 9: 1,995.
inline constexpr int kStroke_10ths = 7;
/// Darkest level of the evened image, in fifths of that of even paper: graphics then look no darker
/// than a weak dot and do not hide the contrast of the dots near them. With 2: 1,937.
inline constexpr int kDarkest_5ths = 4;
}  // namespace smooth

/// Numbers of a patch of the image (detect/patch).
namespace patch {
/// Least side of a patch, in px: 8 dots that are 6 px apart.
inline constexpr int kFewest_px = 48;
/// Darkness of a smoothed dot, in grey levels, below which a tile counts as blank, and the least
/// number of tiles that must be darker.
inline constexpr int kLeastDarkness = 12;
inline constexpr int kFewestTiles = 12;
/// Minima lighter than this share of the typical dot's darkness, in 1/256, are noise.
inline constexpr int kThreshold_q8 = 150;
/// Distance in px, along the axes and diagonally, at which the surroundings of a minimum are
/// tested, and the greatest number of the eight directions in which they may be dark, as beside
/// another dot.
inline constexpr int kAway_px = 4;
inline constexpr int kDiagonally_px = 3;
inline constexpr int kMostDark = 2;
}  // namespace patch

}  // namespace dotpose::core::tuning
