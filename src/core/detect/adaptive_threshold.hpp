// Adaptive threshold: divides the image into tiles, and computes two thresholds for each tile from
// the paper level and the dot contrast. This is the first half of thresholding (paper, section
// II-B.1). The paper uses one global threshold. dotpose does not, because LEDs next to a wide-angle
// lens light the sheet unevenly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// Size of a tile. Tiles are kLowTile_px high if the shorter image side is at most
/// kMaxSideWithLowTiles_px, and kHighTile_px high otherwise. Any three adjacent tiles in a row or
/// column then include part of a dot, provided that at least 8 dots are in view along the shorter
/// side.
inline constexpr int kTileWidth_px = 16;
inline constexpr int kLowTile_px = 8;
inline constexpr int kHighTile_px = 16;
inline constexpr int kMaxSideWithLowTiles_px = 240;
/// Number of bytes that the search for dark pixels may read beyond the last row and beyond the low
/// thresholds. The bytes beyond the row may have any value. The bytes beyond the thresholds contain
/// a sentinel.
inline constexpr int kReadAhead_px = 8;

/// Grey levels of a tile, measured in every fourth row.
struct Tile {
    std::uint8_t mean = 0;
    std::uint8_t darkness = 0;  ///< 255 minus the mean level of the darkest pair of adjacent pixels
};

/// The newest image rows with their tiles, and the thresholds of the current band. A *band* is a
/// row of tiles.
struct AdaptiveThreshold {
    int width_px = 0;
    int height_px = 0;
    int band_px = 0;  ///< tile height, 2^band_shift
    int band_shift = 0;
    int tiles_per_band = 0;
    int rows_taken = 0;
    bool has_contrast = false;  ///< true if any tile so far has contrast
    /// Largest contrast between paper and ink in any tile so far, in grey levels.
    int max_contrast = 0;
    /// Pixels of the two newest bands. Rows are padded to whole tiles.
    std::span<std::uint8_t> rows;
    std::span<Tile> tiles;  ///< tiles of the four newest bands
    /// Half the low threshold of each column in the current band. Pixels darker than the low
    /// threshold belong to a blob. The value is 0 in blank tiles, which have no blobs.
    std::span<std::uint8_t> half_low_levels;
    /// High threshold of each column. A blob must have a pixel darker than this level.
    std::span<std::uint8_t> high_levels;
};

void begin_threshold(int width_px, int height_px, AdaptiveThreshold& threshold);

/// Stores the next row. If it is the last row of a band, also measures the tiles of this band.
/// Returns the number of bands that have become ready for `measure_levels`. This is 0 or 1, except
/// after the last image row, when it may be 2.
int take_row(const std::uint8_t* pixels, AdaptiveThreshold& threshold);

/// Sets the thresholds of one band, from the tiles of this band and of the neighbouring bands. Must
/// be called for each band in order, when `take_row` reports the band as ready.
void measure_levels(int band, const ThresholdOptions& options, AdaptiveThreshold& threshold);

/// Returns the minimum contrast of tiles in the next band, in grey levels. Tiles with less contrast
/// are considered blank. The minimum increases with the largest contrast so far, from
/// `options.min_contrast` to twice this value. After the first tiles with dots, the higher minimum
/// rejects the noise in blank tiles.
int min_tile_contrast(const ThresholdOptions& options, const AdaptiveThreshold& threshold);

inline int band_count(const AdaptiveThreshold& threshold) {
    return (threshold.height_px + threshold.band_px - 1) >> threshold.band_shift;
}
/// Returns the first row of a band. `band_end` returns the row after its last row.
inline int band_begin(const AdaptiveThreshold& threshold, int band) {
    return band * threshold.band_px;
}
inline int band_end(const AdaptiveThreshold& threshold, int band) {
    return std::min((band + 1) * threshold.band_px, threshold.height_px);
}
/// Returns the total width of the tiles in a band, which is also the stride of the stored rows.
inline int whole_width(const AdaptiveThreshold& threshold) {
    return threshold.tiles_per_band * kTileWidth_px;
}
/// Returns a stored row from one of the two newest bands. The row is aligned to 8 bytes, and its
/// last pixel is repeated to fill the last tile.
inline std::uint8_t* kept_row(const AdaptiveThreshold& threshold, int v) {
    const int slot = v & (2 * threshold.band_px - 1);
    return threshold.rows.data() + slot * whole_width(threshold);
}

}  // namespace dotpose::core
