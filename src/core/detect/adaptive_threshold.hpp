// Adaptive threshold: measures the paper level and the contrast of tiles, and sets the thresholds
// of each column. Implements the first half of the thresholding of paper section II-B.1. Differs:
// the paper uses one global threshold, but LEDs next to a wide-angle lens never light the sheet
// evenly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// Width and height of the tiles of the adaptive threshold. The height is kLowTile_px for images
/// whose shorter side is at most `kMaxSideWithLowTiles_px`, and kHighTile_px for larger images.
/// Three adjacent tiles must always contain a part of a dot. The sizes assume that at least 8 dots
/// are visible along the shorter side, and that the spacing is therefore at most 1/8 of this side.
inline constexpr int kTileWidth_px = 16;
inline constexpr int kLowTile_px = 8;
inline constexpr int kHighTile_px = 16;
inline constexpr int kMaxSideWithLowTiles_px = 240;
/// Number of bytes that the search for dark pixels may read beyond the end of the last row and
/// beyond the end of the low thresholds. The bytes beyond the last row may have any value. The
/// bytes beyond the low thresholds contain a sentinel.
inline constexpr int kReadAhead_px = 8;

/// Grey levels of one tile, measured in every fourth row.
struct Tile {
    std::uint8_t mean = 0;
    std::uint8_t darkness = 0;  ///< 255 minus the mean level of the darkest pair of adjacent pixels
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
        0;  ///< largest contrast between paper and ink in all tiles so far, in grey levels
    /// Pixels of the two newest bands. Rows are extended to whole tiles.
    std::span<std::uint8_t> rows;
    std::span<Tile> tiles;  ///< tiles of the four newest bands
    /// Half of the low threshold in each column of the current band. Pixels darker than the low
    /// threshold belong to a blob. The value is 0 in blank tiles, where no pixel belongs to a blob.
    std::span<std::uint8_t> half_low_levels;
    /// High threshold in each column. A blob must contain a pixel darker than this level.
    std::span<std::uint8_t> high_levels;
};

/// Starts a new frame.
void begin_threshold(int width_px, int height_px, AdaptiveThreshold& threshold);

/// Stores the next row. Measures the tiles of a band after its last row. Returns the number of
/// bands that become ready for thresholding with this row: 0 or 1, or up to 2 for the last row of
/// the image.
int take_row(const std::uint8_t* pixels, AdaptiveThreshold& threshold);

/// Sets `threshold.half_low_levels` and `threshold.high_levels` for one band from its tiles and the
/// tiles of the neighbouring bands. Must be called for the bands in order, when `take_row` reports
/// a band as ready.
void measure_levels(int band, const ThresholdOptions& options, AdaptiveThreshold& threshold);

/// Returns the contrast, in grey levels, below which a tile of the next band counts as blank. The
/// result increases with the largest contrast so far, from `options.min_contrast` to twice this
/// value. The increase rejects noise in blank tiles once tiles with dots have been measured.
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
/// Returns the total width of the tiles of a band, which is also the stride of the stored rows.
inline int whole_width(const AdaptiveThreshold& threshold) {
    return threshold.tiles_per_band * kTileWidth_px;
}
/// Returns a stored row of one of the two newest bands. The row is extended to whole tiles by
/// repeating its last pixel, and is aligned to 8 bytes.
inline std::uint8_t* kept_row(const AdaptiveThreshold& threshold, int v) {
    const int slot = v & (2 * threshold.band_px - 1);
    return threshold.rows.data() + slot * whole_width(threshold);
}

}  // namespace dotpose::core
