// Smooth: the filter of the second attempt. The filter normalises the light, averages noise over
// about the area of a blurred dot, and removes single defective pixels. Differs: the paper has no
// such filter. See docs/differs-from-paper.md.
#pragma once

#include <cstdint>
#include <span>

#include "core/detect/paper.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// State of the filter: the rows and sums from which the next filtered row is computed.
struct Smoothing {
    std::span<std::uint16_t> lines;  ///< the five newest rows, filtered along the row
    std::span<std::uint8_t> row;
    int lines_ready = 0;
    int rows_given = 0;
    PaperMap paper;
    /// For each column, the sum of its pixels in the rows [sums_begin, sums_end).
    std::span<std::uint32_t> column_sums;
    int sums_begin = 0;
    int sums_end = 0;
};

/// Grey level to which the mean of the surroundings is scaled.
inline constexpr int kNormalLevel = 192;

/// Starts a new image and discards the state of the previous image.
void begin_smoothing(const ImageView& image, Smoothing& smoothing);

/// Returns the next row of the filtered image, from top to bottom. Each pixel is clamped to the
/// range of its eight neighbours (except at the border of the image), smoothed with a 5 x 5
/// binomial filter (sigma 1 px), and normalised by the mean of a rectangle around it. The row is
/// valid until the next call.
const std::uint8_t* next_smooth_row(const ImageView& image, Smoothing& smoothing);

}  // namespace dotpose::core
