// Light: measures paper level and contrast everywhere in the image, and sets the thresholds. First
// half of the thresholding of paper section II-B.1. differs: the paper thresholds globally; here
// paper and contrast are measured in tiles, because light from LEDs beside a wide lens is never
// even.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/stages.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Starts a frame.
void begin_light(int width_px, int height_px, Light& light);

/// Keeps the next row and measures it. Returns the number of bands that are ready for thresholding
/// with this row: 0 or 1, with the last row of the image up to 2.
int take_row(const std::uint8_t* pixels, Light& light);

/// Sets `light.half_low_levels` and `light.high_levels` for one band from its tiles and those of
/// its neighbours. Bands come in order, each as soon as `take_row` says that it is ready.
void measure_levels(int band, const ThresholdOptions& options, Light& light);

/// Returns the contrast, in grey levels, below which tiles of the next band are blank: where others
/// show dots, what is as pale as noise is no dot.
int least_contrast(const ThresholdOptions& options, const Light& light);

/// Returns the number of bands in the image.
inline int band_count(const Light& light) {
    return (light.height_px + light.band_px - 1) >> light.band_shift;
}
/// Return the first row of a band, and one past its last.
inline int band_begin(const Light& light, int band) {
    return band * light.band_px;
}
inline int band_end(const Light& light, int band) {
    return std::min((band + 1) * light.band_px, light.height_px);
}
/// Returns the width of all tiles, which is the distance between kept rows.
inline int whole_width(const Light& light) {
    return light.tiles_per_band * kTileWidth_px;
}
/// Returns a row of one of the two newest bands: whole tiles, filled past `width_px` with the last
/// pixel. It begins at a multiple of 8 bytes.
inline std::uint8_t* kept_row(const Light& light, int v) {
    const int slot = v & (2 * light.band_px - 1);
    return light.rows.data() + slot * whole_width(light);
}

}  // namespace dotpose::core
