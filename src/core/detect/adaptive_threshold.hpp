// Adaptive threshold: measures paper level and contrast in tiles, and sets the thresholds of each
// column. This is the first half of the thresholding of paper section II-B.1. differs: the paper
// uses one global threshold; LEDs next to a wide lens never light the paper evenly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// Width and height of the tiles of the adaptive threshold. The height is kLowTile_px for images
/// whose shorter side is at most `kMaxSideWithLowTiles_px`, and kHighTile_px for larger images.
/// Three adjacent tiles must contain a dot. If 8 dots are visible along the shorter side, the
/// spacing is at most 1/8 of this side, and a dot is at most a third of the spacing wide.
inline constexpr int kTileWidth_px = 16;
inline constexpr int kLowTile_px = 8;
inline constexpr int kHighTile_px = 16;
inline constexpr int kMaxSideWithLowTiles_px = 240;
/// Number of bytes after the last row and after the last level that may be read. The values of
/// these bytes have no effect.
inline constexpr int kReadAhead_px = 8;

/// Grey levels of one tile.
struct Tile {
    std::uint8_t mean = 0;
    std::uint8_t darkness = 0;  ///< 255 minus the level of the darkest pair of pixels of the tile
};

/// The newest rows of the image with their tiles, and the thresholds of one band. A *band* is a row
/// of tiles.
struct AdaptiveThreshold {
    int width_px = 0;
    int height_px = 0;
    int band_px = 0;  ///< height of the tiles, 2^band_shift
    int band_shift = 0;
    int tiles_per_band = 0;
    int rows_taken = 0;
    bool has_contrast = false;  ///< true if any tile so far has contrast
    int max_contrast =
        0;  ///< largest contrast between paper and ink of all tiles so far, in grey levels
    /// Pixels of the two newest bands. Rows are filled up to whole tiles.
    std::span<std::uint8_t> rows;
    std::span<Tile> tiles;  ///< tiles of the four newest bands
    /// Half of the low threshold in each column of the current band. Pixels darker than the low
    /// threshold belong to a blob. The element is 0 if no pixel belongs to a blob.
    std::span<std::uint8_t> half_low_levels;
    std::span<std::uint8_t>
        high_levels;  ///< high threshold: a blob needs a pixel darker than this level
};

/// Starts a frame.
void begin_threshold(int width_px, int height_px, AdaptiveThreshold& threshold);

/// Stores and measures the next row. Returns the number of bands that are ready for thresholding
/// with this row: 0 or 1, and up to 2 with the last row of the image.
int take_row(const std::uint8_t* pixels, AdaptiveThreshold& threshold);

/// Sets `threshold.half_low_levels` and `threshold.high_levels` for one band from its tiles and the
/// tiles of the neighbouring bands. Must be called for the bands in order, when `take_row` reports
/// a band as ready.
void measure_levels(int band, const ThresholdOptions& options, AdaptiveThreshold& threshold);

/// Returns the contrast, in grey levels, below which tiles of the next band are blank. The limit
/// increases with the largest contrast so far. If some tiles contain dots, noise in the other tiles
/// is thus rejected.
int min_tile_contrast(const ThresholdOptions& options, const AdaptiveThreshold& threshold);

/// Returns the number of bands in the image.
inline int band_count(const AdaptiveThreshold& threshold) {
    return (threshold.height_px + threshold.band_px - 1) >> threshold.band_shift;
}
/// Returns the first row of a band. `band_end` returns the row after the last row of the band.
inline int band_begin(const AdaptiveThreshold& threshold, int band) {
    return band * threshold.band_px;
}
inline int band_end(const AdaptiveThreshold& threshold, int band) {
    return std::min((band + 1) * threshold.band_px, threshold.height_px);
}
/// Returns the width of all tiles of a band, which is the distance between stored rows.
inline int whole_width(const AdaptiveThreshold& threshold) {
    return threshold.tiles_per_band * kTileWidth_px;
}
/// Returns a row of one of the two newest bands: whole tiles, filled beyond `width_px` with the
/// last pixel. The row begins at a multiple of 8 bytes.
inline std::uint8_t* kept_row(const AdaptiveThreshold& threshold, int v) {
    const int slot = v & (2 * threshold.band_px - 1);
    return threshold.rows.data() + slot * whole_width(threshold);
}

}  // namespace dotpose::core
