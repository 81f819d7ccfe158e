// Tuning: the numbers of seeing dots that were found by trying rather than derived. Those of the
// second attempt were found on the hard frames that decode/tuning.hpp names; where a line says what
// other values do, these are frames located by
// `dotpose evaluate --preset hard --frames 2000 --seed 404`: 1,994 with the values as they are.
#pragma once

namespace dotpose::core::tuning {

/// The paper's grey level by blocks (detect/paper).
namespace paper {
/// Side of a block, as a part of the image's shorter side: some spacings even where few dots are in
/// view, and still small against what lamps and lenses darken.
inline constexpr int kBlockPart = 10;
/// Pixels looked at along each side of a block.
inline constexpr int kSamplesPerSide = 12;
/// Share of a block's pixels, in thirds, that are darker than its paper: dots cover less, and of
/// the rest noise is above and below.
inline constexpr int kDarker_3rds = 2;
/// A block whose level is below so many fourths of the brightest around it is covered by graphics,
/// and has their level instead: light changes less than that from block to block.
inline constexpr int kCovered_4ths = 3;
}  // namespace paper

/// Even light for the second attempt (detect/smooth).
namespace smooth {
/// Half the side of the surroundings at the image's border, px: they shrink there, but not below
/// the width of a dot.
inline constexpr int kSmallestHalf_px = 4;
/// What is darker than so many tenths of the brightest paper near by counts as paper in the mean of
/// the surroundings: strokes of graphics are no shadow. With 4: 1,995; with 9: 1,995.
inline constexpr int kStroke_10ths = 7;
/// Level below which all is the same, in fifths of that of even paper: graphics look no darker than
/// a weak dot, and so do not hide the contrast of the dots near them. With 2: 1,937.
inline constexpr int kDarkest_5ths = 4;
}  // namespace smooth

/// A patch of the image (detect/patch).
namespace patch {
/// Fewest px of a patch's side: 8 dots, 6 px apart.
inline constexpr int kFewest_px = 48;
/// Darkness of a smoothed dot, in grey levels, below which a tile counts as blank. So many
/// tiles must have more.
inline constexpr int kLeastDarkness = 12;
inline constexpr int kFewestTiles = 12;
/// Minima lighter than this share of the typical dot's darkness, in 1/256, are noise.
inline constexpr int kThreshold_q8 = 150;
/// How far around a minimum it is looked whether it stands alone, px, along the axes and
/// diagonally, and in how many of the eight directions it may be dark there: as beside another dot.
inline constexpr int kAway_px = 4;
inline constexpr int kDiagonally_px = 3;
inline constexpr int kMostDark = 2;
}  // namespace patch

}  // namespace dotpose::core::tuning
