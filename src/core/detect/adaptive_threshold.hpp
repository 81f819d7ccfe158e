// Adaptive threshold: measures paper level and contrast in tiles and sets the thresholds of each
// column. First half of the thresholding of paper section II-B.1. differs: the paper uses one
// global threshold; LEDs beside a wide lens never light the paper evenly.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/stages.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Starts a frame.
void begin_threshold(int width_px, int height_px, AdaptiveThreshold& threshold);

/// Stores and measures the next row. Returns the number of bands that are ready for thresholding
/// with this row: 0 or 1, and up to 2 with the last row of the image.
int take_row(const std::uint8_t* pixels, AdaptiveThreshold& threshold);

/// Sets `threshold.half_low_levels` and `threshold.high_levels` for one band from its tiles and
/// those of the neighbouring bands. Bands come in order, each when `take_row` reports it ready.
void measure_levels(int band, const ThresholdOptions& options, AdaptiveThreshold& threshold);

/// Returns the contrast, in grey levels, below which tiles of the next band are blank. It increases
/// with the largest contrast so far, which rejects noise if other tiles show dots.
int min_tile_contrast(const ThresholdOptions& options, const AdaptiveThreshold& threshold);

/// Returns the number of bands in the image.
inline int band_count(const AdaptiveThreshold& threshold) {
    return (threshold.height_px + threshold.band_px - 1) >> threshold.band_shift;
}
/// Return the first row of a band, and one past its last.
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
/// last pixel. It begins at a multiple of 8 bytes.
inline std::uint8_t* kept_row(const AdaptiveThreshold& threshold, int v) {
    const int slot = v & (2 * threshold.band_px - 1);
    return threshold.rows.data() + slot * whole_width(threshold);
}

}  // namespace dotpose::core
